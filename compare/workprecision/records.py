"""Ensembles as tables: every way to their means, what it rests on, and what it costs."""

from .ensemble import JudgedEnsemble


def ways(found: JudgedEnsemble) -> list[dict]:
    """All ways to the means of an ensemble, relative to the scale of the truth, with the failures and costs."""
    samples = {(sample.solver, sample.points): sample for sample in found.samples}
    rows = []
    for name, standing in found.standings.items():
        for way in standing.ways:
            for draw in way.draws:
                own = samples[way.solver, draw.points[0]]
                low, high = draw.scatter.interval()
                rows.append(
                    {
                        "regime": found.ensemble.name,
                        "quantity": name,
                        "truth": standing.truth.value,
                        "scale": standing.truth.scale,
                        "truth_standard_error": standing.statistical,
                        "truth_freedom": standing.freedom,
                        "truth_grid_error": standing.discretisation,
                        "solver": way.solver,
                        "way": way.label,
                        "draw": draw.label,
                        "bias": way.bias.value,
                        "bias_least": way.bias.least,
                        "bias_most": way.bias.most,
                        "scatter": draw.scatter.value,
                        "scatter_low": low,
                        "scatter_high": high,
                        "surfaces": own.count,
                        "failed": len(own.reasons),
                        "reason": own.reasons[0] if own.reasons else "",
                        "processor": draw.seconds,
                        "wall": own.costs["wall"],
                        "memory": own.costs["memory"],
                        "applications": own.costs["applications"],
                    }
                )
    return rows
