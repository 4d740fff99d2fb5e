"""Means, tables and files: what does not depend on how a code is run."""

import csv
import io
import math
import os
import tempfile

BLOCKS = 10
TEXTS = {"code", "version", "setting", "tip", "reason", "change"}  # columns; a version may look like a number


def block_mean(forces, start, end):
    """Mean of a force over depths, and its standard error from BLOCKS stretches of equal length.
    `forces`: (depth, weight, force) with weights in time."""
    sums = [[0.0, 0.0] for _ in range(BLOCKS)]
    for depth, weight, force in forces:
        if start <= depth < end:
            block = sums[min(BLOCKS - 1, int((depth - start) / (end - start) * BLOCKS))]
            block[0] += weight
            block[1] += weight * force
    means = [total / weight for weight, total in sums if weight > 0]
    if len(means) < 2:
        return math.nan, math.nan
    mean = sum(total for _, total in sums) / sum(weight for weight, _ in sums)
    return mean, standard_error(means)


def standard_error(values):
    if len(values) < 2:
        return math.nan
    mean = sum(values) / len(values)
    return math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1) / len(values))


def interpolate(points, x):
    """y at x on straight lines through `points` (x, y, label), both in logarithms, with the labels of the two points
    around x; None outside them: nothing is extrapolated."""
    points = sorted(points)
    for (x0, y0, label0), (x1, y1, label1) in zip(points, points[1:]):
        if x0 <= x <= x1 and x0 < x1:
            share = math.log(x / x0) / math.log(x1 / x0)
            return math.exp(math.log(y0) + share * math.log(y1 / y0)), label0, label1
    return None


def digits(value):
    return f"{value:.6g}"


def recorded(value):
    """A number as it is read from a table again."""
    return float(digits(value))


def write_csv(path, columns, rows):
    """The whole table at once, or nothing: a reader never sees a part of it."""
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, extrasaction="ignore", restval="", lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({k: digits(v) if isinstance(v, float) else v for k, v in row.items()})
    write_text(path, text.getvalue())


def write_text(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=path.name)
    try:
        with os.fdopen(handle, "w") as file:
            file.write(text)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def read_csv(path):
    """Rows with numbers as numbers. Tables may follow one another in the file, each with the same head."""
    with open(path, newline="") as file:
        reader = csv.DictReader(file)
        return [{k: v if k in TEXTS else number(v) for k, v in row.items()} for row in reader
                if list(row.values()) != reader.fieldnames]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def print_table(head, rows):
    cells = [head, *rows]
    widths = [max(len(row[k]) for row in cells) for k in range(len(head))]
    for row in (head, ["-" * w for w in widths], *rows):
        print("| " + " | ".join(cell.ljust(w) for cell, w in zip(row, widths)) + " |")
    print()
