"""Sections T1 to T5 and T7 of the report. Every function takes all records and returns Markdown."""

from .markdown import at, distinct, number, select, spread, table


def _grid(records, column_key, column_name, cell, ceiling=True):
    """Rows: detectors; columns: values of column_key; cell(records) -> text."""
    columns = sorted(distinct(records, column_key))
    rows = [
        [d] + [cell(select(records, detector=d, **{column_key: c})) for c in columns]
        for d in distinct(records, "detector")
    ]
    if ceiling:
        rows.append(
            ["*ceiling of recall*"]
            + [spread([r["ceiling"]["1"] for r in _first(records, column_key, c)]) for c in columns]
        )
    return table([column_name] + [f"{c:g}" for c in columns], rows)


def _first(records, column_key, column):
    return select(records, detector=distinct(records, "detector")[0], **{column_key: column})


def _f1(tolerance):
    return lambda part: spread(at(part, tolerance, "f1"))


def _precision_recall(part):
    return f"{spread(at(part, '1', 'precision'), 2)} / {spread(at(part, '1', 'recall'), 2)}"


def block(records):
    text = [
        "## T1 Block: folds and rims",
        "",
        "`arris synth block --spacing 0.25`, `evaluate --edges folds`; "
        "liu and arris with `--classes fold`, peers with all their points. Columns: noise σ/s.",
    ]
    chosen = select(records, table="T1")
    for sampling in distinct(chosen, "sampling"):
        part = select(chosen, sampling=sampling)
        text += ["", f"F1 at tolerance s, sampling {sampling}:", "", _grid(part, "sigma", "F1 (s)", _f1("1"))]
        text += [
            "",
            f"F1 at tolerance 2 s, sampling {sampling}:",
            "",
            _grid(part, "sigma", "F1 (2 s)", _f1("2"), False),
        ]
        text += [
            "",
            f"Precision / recall at tolerance s, sampling {sampling}:",
            "",
            _grid(part, "sigma", "P / R", _precision_recall, False),
        ]
    outliers = select(records, table="T1o")
    if outliers:
        text += [
            "",
            "With stray points (share of all points), jittered, σ = 0.2 s, F1 at tolerance s:",
            "",
            _grid(outliers, "outliers", "outliers", _f1("1")),
        ]
    return "\n".join(text)


def plates(records):
    text = [
        "## T2 Plates: boundary",
        "",
        "`arris synth plates --spacing 0.25`, `evaluate --edges boundaries`; liu and arris "
        "with `--classes boundary`, peers with all their points. Columns: noise σ/s.",
    ]
    chosen = select(records, table="T2")
    for gap, sampling in sorted({(r["gap"], r["sampling"]) for r in chosen}):
        part = select(chosen, gap=gap, sampling=sampling)
        for tolerance in ("1", "2"):
            name = "s" if tolerance == "1" else "2 s"
            text += [
                "",
                f"Gap {gap:g} s, {sampling}, F1 at tolerance {name}:",
                "",
                _grid(part, "sigma", f"F1 ({name})", _f1(tolerance), tolerance == "1"),
            ]
    return "\n".join(text)


def angles(records):
    text = [
        "## T3 Dihedral sweep: recall by interior angle",
        "",
        "`arris synth dihedral --spacing 0.05`, jittered; tolerance s; "
        "all classes, and *(folds)*: points classed as folds alone. Last column: share of all points "
        "detected farther than 2 s from every fold and border, without which recall says little.",
    ]
    chosen = select(records, table="T3")
    for sigma in sorted(distinct(chosen, "sigma")):
        part = select(chosen, sigma=sigma)
        names = list(part[0]["recall"])
        rows = [
            [d]
            + [spread([r["recall"][a]["1"] for r in select(part, detector=d)], 2) for a in names]
            + [spread([r["far_share"] for r in select(part, detector=d)], 2, 100.0) + " %"]
            for d in distinct(part, "detector")
        ]
        text += ["", f"σ = {sigma:g} s:", "", table(["recall"] + [f"{a}°" for a in names] + ["far"], rows)]
    return "\n".join(text)


def alarms(records):
    chosen = select(records, table="T4")
    columns = list(dict.fromkeys((r["scene"], r["sampling"], r["sigma"]) for r in chosen))
    rows = [
        [d]
        + [
            spread([r["share"] for r in select(chosen, detector=d, scene=a, sampling=b, sigma=c)], 2, 100.0)
            for a, b, c in columns
        ]
        for d in distinct(chosen, "detector")
    ]
    head = [" ".join(p for p in (a, b or "", f"σ {c:g} s" if b else "") if p) for a, b, c in columns]
    return "\n".join(
        [
            "## T4 False alarms: detected share of the points, %",
            "",
            "Plane (points within 2 s of its border do "
            "not count), sphere of radius 50 s, cube filled with random points. Boundaries and folds "
            "together.",
            "",
            table(["%"] + head, rows),
        ]
    )


def town(records):
    chosen = select(records, table="T5")
    rows = []
    for d in distinct(chosen, "detector"):
        part = select(chosen, detector=d)
        rows.append(
            [d]
            + [spread(at(part, "1", "f1"))]
            + [spread(at(part, "2", m)) for m in ("f1", "precision", "recall")]
            + [spread([r["ceiling"]["2"] for r in part]), spread([r["seconds"] for r in part], 1)]
        )
    points = sum(r["points"] for r in chosen) // max(1, len(chosen))
    return "\n".join(
        [
            "## T5 Town: simulated terrestrial scan",
            "",
            f"`arris synth town`, {points} points on average, 2 mm " "noise; all edges, all classes.",
            "",
            table(
                ["detector", "F1 (s)", "F1 (2 s)", "P (2 s)", "R (2 s)", "ceiling of R (2 s)", "seconds, one thread"],
                rows,
            ),
        ]
    )


def motion(records):
    chosen = select(records, table="T7")
    variants = distinct(chosen, "variant")
    rows = []
    for d in distinct(chosen, "detector"):
        still = {r["seed"]: r["f1"] or 0.0 for r in select(chosen, detector=d, variant=variants[0])}
        row = [d, spread(list(still.values()))]
        for variant in variants[1:]:
            part = select(chosen, detector=d, variant=variant)
            change = max((abs((r["f1"] or 0.0) - still[r["seed"]]) for r in part if r["seed"] in still), default=None)
            same = (
                "the same points"
                if all(r["same"] for r in part)
                else "Jaccard " + number(min(r["jaccard"] or 0.0 for r in part))
            )
            row.append(f"{number(change, 4)}, {same}")
        rows.append(row)
    return "\n".join(
        [
            "## T7 Moving the cloud",
            "",
            "Block, jittered, σ = 0.2 s. F1 at tolerance s as it is; then for each motion "
            "the largest change of F1 over the seeds, and whether the same points (by index, with the same "
            "class) are detected; if not, the least Jaccard index over the seeds. Shift: 500000, 5000000, 100.",
            "",
            table(["detector", f"F1 {variants[0]}"] + variants[1:], rows),
        ]
    )
