"""Makes clouds, runs all jobs on them in turn, and writes the records, the table and the plot."""

import argparse
import glob
import json
import os
import statistics
import sys
from types import SimpleNamespace

from . import report
from .clouds import make_cloud
from .jobs import jobs_for
from .measure import Failure, run, touch, wall_of_all

GIB = 1 << 30


def parse(arguments):
    parser = argparse.ArgumentParser(prog="bench/scale/run", description=__doc__)
    parser.add_argument("--work", default="scale", help="folder for clouds and results (default: %(default)s)")
    parser.add_argument("--build", default="build/bench", help="built with -DARRIS_BENCH=ON (default: %(default)s)")
    parser.add_argument("--millions", type=float, nargs="+", default=[1, 5, 20, 100], help="sizes of the clouds")
    parser.add_argument("--peers-up-to", type=float, default=20, help="millions of points (default: %(default)s)")
    parser.add_argument("--peer-memory-gib", type=float, default=20, help="address space of a peer")
    parser.add_argument("--runs", type=int, default=3, help="medians are of so many, in turn (default: %(default)s)")
    parser.add_argument("--memory", default="1GiB", help="budget of arris (default: %(default)s)")
    parser.add_argument("--threads", type=int, nargs="+", default=[1], help="of arris, each in every turn; of peers the first")
    parser.add_argument("--beside", action="store_true",
                        help="as many processes at once as the last of --threads, too, each with the first: what the machine gives")
    parser.add_argument("--touch-mib", type=int, default=0,
                        help="memory to write to before each run: where a host takes pages back, the first touch is dear")
    parser.add_argument("--only", default="", help="jobs whose task or name has this in it")
    return parser.parse_args(arguments)


def measure(job, places, settings):
    """The record of one run; what a report of arris says of it beside."""
    told = os.path.join(places.work, "report.json")
    limit = round(settings.peer_memory_gib * GIB) if job.peer else None
    # Pages of an output would be given up while others are written.
    for old in glob.glob(os.path.join(places.work, "out*.las")) + glob.glob(os.path.join(places.work, "report*.json")):
        os.remove(old)
    touch(settings.touch_mib << 20)
    record = run(job.command, places.temp, limit, job.environment)
    if not job.peer:
        with open(told) as file:
            said = json.load(file)
        record["predicted_peak_mib"] = said["memory"]["predicted_peak_bytes"] / 2**20
        record["predicted_temp_bytes"] = said["temp"]["predicted_bytes"]
    if job.copies:
        touch(settings.touch_mib << 20)
        record["copies"], record["copies_wall_s"] = len(job.copies), wall_of_all(job.copies)
    return record


def median_of(records):
    return {key: statistics.median(r[key] for r in records) for key in records[0]}


def measure_all(cloud, places, settings):
    jobs = [j for j in jobs_for(cloud, places, settings) if settings.only in j.task or settings.only in j.name]
    if cloud.millions > settings.peers_up_to:
        jobs = [j for j in jobs if not j.peer]
    jobs = [j for j in jobs if cloud.millions <= j.most_millions]
    runs, failed = {}, {}
    for turn in range(settings.runs):
        for job in jobs:
            key = job.name, job.threads
            if key in failed:
                continue
            if not job.available:
                failed[key] = "not built or not installed"
                continue
            try:
                record = measure(job, places, settings)
            except Failure as failure:
                failed[key] = str(failure)
                continue
            runs.setdefault(key, []).append(record)
            print(f"{cloud.millions:g} M, {job.name}, {job.threads} thr.: {record['cpu_s']:.2f} CPU s, {record['wall_s']:.2f} s, "
                  f"{record['peak_mib']:.0f} MiB", flush=True)
    for job in jobs:
        key = job.name, job.threads
        base = {"task": job.task, "name": job.name, "peer": job.peer, "threads": job.threads,
                "millions": cloud.millions, "points": cloud.points}
        if key in failed:
            print(f"{cloud.millions:g} M, {job.name}: {failed[key]}", flush=True)
            yield {**base, "failed": failed[key]}
        else:
            yield {**base, "runs": runs[key], **median_of(runs[key])}


def main(arguments):
    settings = parse(arguments)
    here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    places = SimpleNamespace(here=here, bin=os.path.abspath(os.path.join(settings.build, "bin")),
                             work=os.path.abspath(settings.work), temp=os.path.abspath(os.path.join(settings.work, "temp")))
    os.makedirs(places.temp, exist_ok=True)
    if not os.path.exists(os.path.join(places.bin, "arris")):
        sys.exit(f"bench/scale/run: no {places.bin}/arris; build with -DARRIS_BENCH=ON, or say where with --build")
    records = []
    for millions in settings.millions:
        cloud = make_cloud(places, millions)
        records += measure_all(cloud, places, settings)
        # After every size: a long run that is stopped leaves what it has.
        with open(os.path.join(places.work, "scale.json"), "w") as file:
            json.dump(records, file, indent=1)
        with open(os.path.join(places.work, "scale.md"), "w") as file:
            file.write(report.table(records) + "\n")
        report.plot(records, os.path.join(places.work, "scale.svg"))
    print(report.table(records))
