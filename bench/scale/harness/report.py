"""One table, and time and memory against size as a plot."""

import matplotlib

matplotlib.use("Agg")
# Same bytes for the same numbers: no date and no random identifiers in the SVG.
matplotlib.rcParams["svg.hashsalt"] = "arris"
from matplotlib import pyplot  # noqa: E402  (after the backend is chosen)

HEAD = ["points", "task", "program", "threads", "CPU s", "µs per point", "wall s", "wall, first / these threads",
        "peak MiB", "foretold / measured", "temporary B per point", "foretold / measured", "CPU, peer / arris",
        "memory, peer / arris"]


def table(records):
    lines = ["| " + " | ".join(HEAD) + " |", "|--:|---|---|" + "--:|" * (len(HEAD) - 3)]
    for r in records:
        cells = [f"{r['millions']:g} M", r["task"], f"`{r['name']}`" if not r["peer"] else r["name"],
                 str(r["threads"])]
        if "failed" in r:
            cells += [r["failed"]] + [""] * (len(HEAD) - 5)
        else:
            own = None if not r["peer"] else best_own(records, r)
            cells += [f"{r['cpu_s']:.1f}", f"{1e6 * r['cpu_s'] / r['points']:.2f}", f"{r['wall_s']:.1f}",
                      speed_up(records, r), f"{r['peak_mib']:.0f}"]
            cells += ["", "", ""] if r["peer"] else [
                foretold(r, lambda run: run["predicted_peak_mib"] / run["peak_mib"]),
                f"{r['temp_bytes'] / r['points']:.1f}",
                foretold(r, lambda run: run["predicted_temp_bytes"] / max(1, run["temp_bytes"]))]
            cells += [ratio(r, own, "cpu_s"), ratio(r, own, "peak_mib")]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def speed_up(records, record):
    """Of medians, and between pairs of runs of the same turn; nothing for the first number of threads."""
    for first in records:
        if (first["name"], first["millions"]) == (record["name"], record["millions"]):
            break
    if first is record or "failed" in first:
        return ""
    pairs = [a["wall_s"] / b["wall_s"] for a, b in zip(first["runs"], record["runs"])]
    gain = f"{first['wall_s'] / record['wall_s']:.2f} ({min(pairs):.2f} to {max(pairs):.2f})"
    if first.get("copies") != record["threads"]:
        return gain
    # So much more gets done in the same time when every thread is a process that shares nothing.
    return f"{gain}; processes {first['copies'] * first['wall_s'] / first['copies_wall_s']:.2f}"


def foretold(record, quotient):
    """From the least to the largest of the runs."""
    found = [quotient(run) for run in record["runs"]]
    least, largest = f"{min(found):.2f}", f"{max(found):.2f}"
    return least if least == largest else f"{least} to {largest}"


def best_own(records, peer):
    """The first job of arris for the same task and size: the one that does the same work."""
    for r in records:
        if not r["peer"] and r["task"] == peer["task"] and r["millions"] == peer["millions"] and "failed" not in r:
            return r
    return None


def ratio(peer, own, key):
    return f"{peer[key] / own[key]:.1f}" if own else ""


def plot(records, path):
    figure, axes = pyplot.subplots(1, 2, figsize=(11.0, 5.2))
    known = [r for r in records if "failed" not in r and r["threads"] == records[0]["threads"]]
    for number, name in enumerate(dict.fromkeys((r["task"], r["name"]) for r in known)):
        part = [r for r in known if (r["task"], r["name"]) == name]
        style = {"marker": "o", "markersize": 3.5, "linestyle": "--" if part[0]["peer"] else "-", "color": pyplot.cm.tab20(number)}
        size = [r["points"] for r in part]
        axes[0].plot(size, [1e6 * r["cpu_s"] / r["points"] for r in part], label=name[1], **style)
        axes[1].plot(size, [r["peak_mib"] for r in part], **style)
    for panel, title in zip(axes, ["CPU µs per point", "peak resident, MiB"]):
        panel.set_xscale("log")
        panel.set_yscale("log")
        panel.set_xlabel("points")
        panel.set_title(title)
        panel.grid(alpha=0.3, which="both")
    figure.legend(loc="lower center", ncol=2, fontsize=8)
    figure.tight_layout(rect=(0.0, 0.2, 1.0, 1.0))
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)
