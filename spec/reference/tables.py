"""The tables of compact-tables.md, read from the page itself."""

import functools
import pathlib
import re

PAGE = pathlib.Path(__file__).resolve().parents[1] / "compact-tables.md"
CLASSES = 24


@functools.cache
def blocks():
    """The numbers of each block of the page, row by row."""
    text = PAGE.read_text(encoding="utf-8")
    return [[[int(word) for word in line.split()] for line in block.strip().splitlines()]
            for block in re.findall(r"```\n(.*?)```", text, re.DOTALL)]


def knots():
    """Probabilities for logarithms of odds in steps of a half."""
    return [number for row in blocks()[5] for number in row]


def chord_weights(placement):
    """For each kind a number for each class, times 64."""
    return [[64 * weight for weight in row] for row in blocks()[placement]]


def step_weights(placement, near, far, is_open):
    """Six weights by the number of places to the other end and the number of the other places."""
    if is_open:
        return blocks()[4][placement]
    row = blocks()[2 + placement][6 * (min(near, 6) - 1) + min(far, 6) - 1]
    return row[2:]
