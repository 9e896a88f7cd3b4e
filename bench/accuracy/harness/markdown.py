"""Markdown tables of means over seeds."""


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "|".join(["---"] + ["--:"] * (len(head) - 1)) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def spread(values, digits=3, scale=1.0):
    """Mean, and half the range over the seeds if there are several; "–" for none."""
    known = [v * scale for v in values if v is not None]
    if not known:
        return "–"
    text = number(sum(known) / len(known), digits)
    return text if len(known) < 2 else f"{text} ±{number((max(known) - min(known)) / 2.0, digits)}"


def number(value, digits=3):
    if value is None:
        return "–"
    text = f"{value:.{digits}f}"
    return text.replace("0.", ".", 1) if text.startswith("0.") else text


def select(records, **wanted):
    return [r for r in records if all(r.get(k) == v for k, v in wanted.items())]


def distinct(records, key):
    """Values in the order in which they first appear."""
    return list(dict.fromkeys(r[key] for r in records))


def at(records, tolerance, metric):
    """Values of a metric at a tolerance in spacings ("1", "2"), one per record."""
    return [r["at"][tolerance][metric] for r in records if tolerance in r["at"]]
