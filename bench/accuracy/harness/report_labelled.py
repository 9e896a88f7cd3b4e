"""Section T6 of the report."""

from .markdown import distinct, number, select, table


def _mean(values):
    known = [v for v in values if v is not None]
    return sum(known) / len(known) if known else None


def labelled(records):
    chosen = select(records, table="T6")
    names, clouds = distinct(chosen, "detector"), distinct(chosen, "cloud")
    groups = (
        ("all clouds", clouds),
        ("labelled by file", [c for c in clouds if c.endswith("(labels)")]),
        ("labelled by edge points, clean", [c for c in clouds if not c.endswith("(labels)") and not _noisy(c)]),
        ("labelled by edge points, noisy", [c for c in clouds if not c.endswith("(labels)") and _noisy(c)]),
    )
    text = [
        "## T6 Clouds with labelled edges",
        "",
        "What the files hold: bench/accuracy/README.md. Points against labelled "
        "points at tolerance s (`arris info`'s spacing of each cloud), all classes of every detector.",
        "",
        "F1 per cloud:",
        "",
    ]
    rows = []
    for cloud in clouds:
        part = select(chosen, cloud=cloud)
        rows.append(
            [cloud, str(part[0]["points"]), str(part[0]["edge_points"]), f"{part[0]['spacing']:.4g}"]
            + [number(_mean(r["f1"] for r in select(part, detector=d))) for d in names]
        )
    for title, members in groups:
        if members:
            rows.append(
                [f"**mean, {title}**", "", "", ""]
                + [
                    f"**{number(_mean(r['f1'] for r in chosen if r['detector'] == d and r['cloud'] in members))}**"
                    for d in names
                ]
            )
    text.append(table(["cloud", "points", "edge points", "s", *names], rows))
    rows = []
    for d in names:
        part = select(chosen, detector=d)
        curves = [r["curve"] for r in part if "curve" in r]
        rows.append(
            [d]
            + [number(_mean(r[m] for r in part)) for m in ("precision", "recall", "f1")]
            + [number(_mean(r["exact"][m] for r in part)) for m in ("precision", "recall", "f1", "iou", "mcc")]
            + [number(_mean(r["exact_without_band"]["f1"] for r in part)), number(_mean(c["f1"] for c in curves))]
        )
    text += [
        "",
        "Means over the clouds. *exact*: the very points that are labelled; *no band*: points of the band that some "
        "files name around their edges left out; *curve*: against the dense points on the true edges, where "
        "given.",
        "",
        table(
            [
                "detector",
                "P (s)",
                "R (s)",
                "F1 (s)",
                "exact P",
                "exact R",
                "exact F1",
                "IoU",
                "MCC",
                "exact F1, no band",
                "curve F1",
            ],
            rows,
        ),
    ]
    return "\n".join(text)


def _noisy(name):
    return "oise" in name or "Guass" in name
