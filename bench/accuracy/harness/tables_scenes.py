"""T1, T2, T5: F1 on scenes."""

from . import scene_cells

SIGMAS = (0.0, 0.05, 0.1, 0.2, 0.4, 0.8)
BLOCK_SPACING_M = 0.25
PLATES_SPACING_M = 0.25
TOWN_POINTS = 3_000_000

measure = scene_cells.measure


def surface_options(spacing, sigma, sampling):
    """Options of synth; sigma in spacings."""
    return ["--spacing", repr(spacing), "--noise", repr(round(sigma * spacing, 9)), "--sampling", sampling]


def _block(settings, table, sampling, sigma, outliers, seed):
    return {
        "table": table,
        "scene": "block",
        "seed": seed,
        "edges": "folds",
        "typed_classes": "fold",
        "main_tolerance": 1.0,
        "options": surface_options(BLOCK_SPACING_M, sigma, sampling) + ["--outliers", repr(outliers)],
        "key": {"sampling": sampling, "sigma": sigma, "outliers": outliers},
    }


def block_cells(settings):
    sigmas = (0.0, 0.2) if settings.quick else SIGMAS
    return [
        _block(settings, "T1", sampling, sigma, 0.0, seed)
        for seed in settings.seeds
        for sampling in settings.samplings
        for sigma in sigmas
    ]


def outlier_cells(settings):
    shares = (0.01,) if settings.quick else (0.0, 0.01, 0.05)
    return [_block(settings, "T1o", "jittered", 0.2, share, seed) for seed in settings.seeds for share in shares]


def plates_cells(settings):
    plan = [(4.0, sampling, sigma) for sampling in settings.samplings for sigma in (0.0, 0.2, 0.4)]
    if not settings.quick:
        plan += [(gap, "jittered", sigma) for gap in (2.0, 8.0) for sigma in (0.0, 0.2)]
    return [
        {
            "table": "T2",
            "scene": "plates",
            "seed": seed,
            "edges": "boundaries",
            "typed_classes": "boundary",
            "main_tolerance": 1.0,
            "options": surface_options(PLATES_SPACING_M, sigma, sampling) + ["--set", f"gap_spacings={gap:g}"],
            "key": {"gap": gap, "sampling": sampling, "sigma": sigma},
        }
        for seed in settings.seeds
        for gap, sampling, sigma in plan
    ]


def town_cells(settings):
    local = settings.programs.has_option("evaluate", "--local-spacing")
    judge = ("--local-spacing",) if local else ()
    settings.notes.append(
        "T5: tolerances in "
        + (
            "local spacings (evaluate --local-spacing)."
            if local
            else "spacings of the scene; this build has no `evaluate --local-spacing`."
        )
    )
    points = 300_000 if settings.quick else TOWN_POINTS
    return [
        {
            "table": "T5",
            "scene": "town",
            "seed": seed,
            "edges": "all",
            "typed_classes": "all",
            "main_tolerance": 2.0,
            "options": ["--points", points, "--noise", "2mm"],
            "judge": judge,
            "key": {"judge": " ".join(judge)},
        }
        for seed in settings.seeds
    ]
