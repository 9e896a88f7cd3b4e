"""F1 against noise, one panel per sampling."""

import matplotlib

matplotlib.use("Agg")
# Same bytes for the same numbers: no date and no random identifiers in the SVG.
matplotlib.rcParams["svg.hashsalt"] = "arris"
from matplotlib import pyplot  # noqa: E402  (after the backend is chosen)

from .markdown import at, distinct, select  # noqa: E402


def f1_against_noise(records, path):
    """T1 at tolerance s, means over seeds with their range. Nothing is drawn without records of T1."""
    chosen = select(records, table="T1")
    if not chosen:
        return False
    samplings = distinct(chosen, "sampling")
    figure, axes = pyplot.subplots(1, len(samplings), figsize=(5.2 * len(samplings), 4.2), sharey=True, squeeze=False)
    for panel, sampling in zip(axes[0], samplings):
        part = select(chosen, sampling=sampling)
        sigmas = sorted(distinct(part, "sigma"))
        for number, detector in enumerate(distinct(part, "detector")):
            values = [at(select(part, detector=detector, sigma=s), "1", "f1") for s in sigmas]
            known = [(s, v) for s, v in zip(sigmas, values) if v]
            mean = [sum(v) / len(v) for _, v in known]
            colour = f"C{number}"
            panel.plot([s for s, _ in known], mean, marker="o", markersize=3.5, color=colour, label=detector)
            panel.fill_between(
                [s for s, _ in known],
                [min(v) for _, v in known],
                [max(v) for _, v in known],
                color=colour,
                alpha=0.15,
                lw=0,
            )
        panel.set_title(f"block, folds and rims, {sampling}")
        panel.set_xlabel("noise σ / s")
        panel.set_ylim(0.0, 1.02)
        panel.grid(alpha=0.3)
    axes[0][0].set_ylabel("F1 at tolerance s")
    axes[0][-1].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)
    return True
