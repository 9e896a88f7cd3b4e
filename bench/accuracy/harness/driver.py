"""Options, the queue of cells, and the files that come out."""

import argparse
import concurrent.futures
import json
import os
import shutil
import sys
import tempfile
import threading
import time

from . import detectors, plot, report_labelled, report_scenes, table_labelled, tables_behaviour, tables_scenes
from .programs import ProgramError, Programs

# name -> (cells, measure, section of the report; None: shown in another's section)
TABLES = {
    "T6": (table_labelled.cells, table_labelled.measure, report_labelled.labelled),
    "T1": (tables_scenes.block_cells, tables_scenes.measure, report_scenes.block),
    "T1o": (tables_scenes.outlier_cells, tables_scenes.measure, None),
    "T2": (tables_scenes.plates_cells, tables_scenes.measure, report_scenes.plates),
    "T3": (tables_behaviour.angle_cells, tables_behaviour.angle_measure, report_scenes.angles),
    "T4": (tables_behaviour.alarm_cells, tables_behaviour.alarm_measure, report_scenes.alarms),
    "T5": (tables_scenes.town_cells, tables_scenes.measure, report_scenes.town),
    "T7": (tables_behaviour.motion_cells, tables_behaviour.motion_measure, report_scenes.motion),
}


class Settings:
    """What the tables need to know. notes: remarks for the report, in order."""

    def __init__(self, options):
        self.quick = options.quick
        self.seeds = options.seeds[:1] if options.quick else options.seeds
        self.data = options.data
        self.samplings = options.samplings.split(",")[: 1 if options.quick else None]
        self.best_stride = 3 if options.quick else 1
        self.notes = []
        self.failures = 0
        self._lock = threading.Lock()
        self.programs = Programs(options.build)
        self.detectors = detectors.choose(options.detectors, self.programs, self.notes)
        if not self.detectors:
            raise SystemExit("no detector is left")

    def note_once(self, text):
        with self._lock:
            if text not in self.notes:
                self.notes.append(text)

    def detections(self, cloud, spacing, folder, where, points=0, best=True):
        """Pairs of detector and labels on a cloud file, one after the other. Without those that such a cloud is
        too much for (points), those that need the truth (unless best), and those that fail, which the notes tell.

        @param where  the cloud in words.
        """
        for detector in self.detectors:
            if detector.best and not best:
                continue
            if points > detector.most_points:
                self.note_once(f"{where}: `{detector.name}` is left out, more than {detector.most_points} points.")
                continue
            try:
                labels = detector.detect(self.programs, cloud, spacing, os.path.join(folder, "labels.ply"))
            except ProgramError as error:
                self.failures += 1
                self.note_once(f"{where}: `{detector.name}` failed: {error}")
                continue
            yield detector, labels


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="bench/accuracy/run", description="The table of accuracy, as Markdown, JSON and SVG."
    )
    parser.add_argument(
        "--build", default="build/bench", help="build folder, configured with -DARRIS_BENCH=ON (default %(default)s)"
    )
    parser.add_argument("--work", default="accuracy", help="folder for the results (default %(default)s)")
    parser.add_argument(
        "--seeds",
        default="21,22,23",
        help="seeds, joined by commas (default %(default)s; 11 to 13 are for development)",
    )
    parser.add_argument("--tables", default=",".join(TABLES), help="of %(default)s")
    parser.add_argument(
        "--scenes", default="", help="leave out tables of other scenes: block, plates, dihedral, plain, town, labelled"
    )
    parser.add_argument(
        "--samplings", default="jittered,random", help="of T1, T2, T4 (default %(default)s; see arris synth --help)"
    )
    parser.add_argument("--detectors", default=",".join(detectors.DEFAULT), help="of %(default)s")
    parser.add_argument(
        "--data",
        default=os.environ.get("ARRIS_SHARED_DATA", ""),
        help="folder of the labelled clouds (default $ARRIS_SHARED_DATA)",
    )
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="clouds at a time (default: processors)")
    parser.add_argument("--quick", action="store_true", help="one seed, few cells")
    options = parser.parse_args(arguments)
    options.seeds = [int(s) for s in options.seeds.split(",")]
    options.detectors = options.detectors.split(",")
    options.tables = options.tables.split(",")
    unknown = [t for t in options.tables if t not in TABLES]
    if unknown:
        parser.error(f"--tables: {', '.join(unknown)} is none of {', '.join(TABLES)}")
    of_scene = {
        "block": ("T1", "T1o", "T7"),
        "plates": ("T2",),
        "dihedral": ("T3",),
        "plain": ("T4",),
        "town": ("T5",),
        "labelled": ("T6",),
    }
    if options.scenes:
        chosen = options.scenes.split(",")
        for scene in chosen:
            if scene not in of_scene:
                parser.error(f"--scenes: '{scene}' is none of {', '.join(of_scene)}")
        options.tables = [t for t in options.tables if any(t in of_scene[scene] for scene in chosen)]
    return options


def _run_cell(measure, cell, settings, work):
    folder = tempfile.mkdtemp(prefix="cell-", dir=work)
    try:
        return measure(cell, settings, folder)
    finally:
        shutil.rmtree(folder)


def run(settings, options):
    """All records, in the order of the cells whatever the number of jobs. A cell that fails is told in the notes."""
    records, start = [], time.monotonic()
    work = [(name, cell) for name in options.tables for cell in TABLES[name][0](settings)]
    terminal = sys.stderr.isatty()
    with concurrent.futures.ThreadPoolExecutor(max(1, options.jobs)) as pool:
        futures = [pool.submit(_run_cell, TABLES[name][1], cell, settings, options.work) for name, cell in work]
        try:
            for i, ((name, _), future) in enumerate(zip(work, futures)):
                try:
                    records += future.result()
                except ProgramError as error:
                    settings.failures += 1
                    settings.note_once(f"{name}: a cloud is missing: {error}")
                last = i + 1 == len(work) or work[i + 1][0] != name
                if terminal or last:
                    text = f"{i + 1}/{len(work)} clouds, {name}, {time.monotonic() - start:.0f} s"
                    print(f"\r{text} " if terminal else text, end="" if terminal else "\n", file=sys.stderr, flush=True)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    if terminal:
        print(file=sys.stderr)
    return records, time.monotonic() - start


def write(settings, options, records, seconds):
    described = "\n".join(f"* `{d.name}`: {d.what}" for d in settings.detectors)
    drawn = plot.f1_against_noise(records, os.path.join(options.work, "f1_noise.svg"))
    head = [
        "# Accuracy",
        "",
        f"{settings.programs.version()}; seeds {', '.join(map(str, settings.seeds))}; means, ± half the range over "
        f"the seeds; {'quick run, ' if settings.quick else ''}{seconds / 60:.0f} minutes. "
        "s: point spacing. *Ceiling*: recall that labelling "
        "every input point would have.",
        "",
        described,
    ]
    if settings.notes:
        head += ["", *[f"* {note}" for note in settings.notes]]
    if drawn:
        head += ["", "![F1 against noise](f1_noise.svg)"]
    present = {r["table"] for r in records}
    sections = [TABLES[name][2](records) for name in sorted(TABLES) if TABLES[name][2] and name in present]
    with open(os.path.join(options.work, "accuracy.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(head) + "\n\n" + "\n\n".join(sections) + "\n")
    with open(os.path.join(options.work, "accuracy.json"), "w", encoding="utf-8") as file:
        json.dump(
            {
                "schema": "arris-accuracy/1",
                "version": settings.programs.version(),
                "seeds": settings.seeds,
                "quick": settings.quick,
                "notes": settings.notes,
                "detectors": {d.name: d.what for d in settings.detectors},
                "records": records,
            },
            file,
            indent=1,
        )


def main(arguments):
    options = parse(arguments)
    try:
        settings = Settings(options)
        os.makedirs(options.work, exist_ok=True)
        records, seconds = run(settings, options)
        write(settings, options, records, seconds)
    except ProgramError as error:
        raise SystemExit(f"bench/accuracy/run: {error}") from error
    print(
        f"{options.work}/accuracy.md, accuracy.json"
        + (", f1_noise.svg" if any(r["table"] == "T1" for r in records) else "")
    )
    if settings.failures:
        raise SystemExit(f"bench/accuracy/run: {settings.failures} runs failed; see the notes of the report")
