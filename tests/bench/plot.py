"""Plots as SVG, written by hand: points and lines over logarithmic or plain axes."""

import html
import math

WIDTH, HEIGHT = 1000, 680
LEFT, TOP, BOTTOM = 80, 50, 60
LABEL_HEIGHT = 14
CHARACTER = 6.6  # width at 11 px, on average

COLOURS = ["#1f77b4", "#ff7f0e", "#2ca02c", "#9467bd", "#8c564b", "#e377c2", "#17becf", "#bcbd22",
           "#4d4d4d", "#6b8e23"]


class Axis:
    """Maps values to places from `start` to `end`."""

    def __init__(self, values, start, end, log):
        self.log, self.start, self.end = log, start, end
        scaled = [self._scale(v) for v in values]
        low, high = min(scaled), max(scaled)
        margin = 0.05 * (high - low) or 0.5
        self.low, self.high = low - margin, high + margin

    def _scale(self, value):
        return math.log10(value) if self.log else value

    def at(self, value):
        part = (self._scale(value) - self.low) / (self.high - self.low)
        return self.start + part * (self.end - self.start)

    def ticks(self):
        """Round values within the axis: 1, 2 and 5 of each decade, or five to ten equal steps."""
        if self.log:
            candidates = [m * 10.0 ** e for e in range(math.floor(self.low), math.ceil(self.high))
                          for m in (1, 2, 5)]
            return [v for v in candidates if self.low <= math.log10(v) <= self.high]
        rough = (self.high - self.low) / 6
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(m * power for m in (1, 2, 5, 10) if m * power >= rough)
        first = math.ceil(self.low / step)
        return [i * step for i in range(first, math.floor(self.high / step) + 1)]


def number(value):
    for unit, sign in ((1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:g}{sign}"
    return f"{value:.6g}"


class Plot:
    """Collect points and lines first, then `write`."""

    def __init__(self, title, x_title, y_title, log_x=True, log_y=False, right=40):
        self.title, self.x_title, self.y_title = title, x_title, y_title
        self.log_x, self.log_y, self.right = log_x, log_y, WIDTH - right
        self.lines, self.points = [], []

    def line(self, places, colour, name="", width=1.5, dash="", at_end=False):
        """`at_end` writes the name right of the last place."""
        self.lines.append((places, colour, name, width, dash, at_end))

    def point(self, x, y, colour, label="", radius=4, hollow=False):
        self.points.append((x, y, colour, label, radius, hollow))

    def write(self, path):
        places = [p for line in self.lines for p in line[0]] + [p[:2] for p in self.points]
        self.x = Axis([p[0] for p in places], LEFT, self.right, self.log_x)
        self.y = Axis([p[1] for p in places], HEIGHT - BOTTOM, TOP, self.log_y)
        out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
               'font-family="sans-serif" font-size="11">',
               f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
        out += self._frame() + self._drawn_lines() + self._drawn_points()
        out.append("</svg>\n")
        path.write_text("\n".join(out), encoding="utf-8")

    def _frame(self):
        bottom, middle = HEIGHT - BOTTOM, (LEFT + self.right) / 2
        out = [text(middle, 28, self.title, anchor="middle", size=16),
               text(middle, HEIGHT - 14, self.x_title, anchor="middle", size=13),
               f'<g transform="rotate(-90)">'
               f'{text(-(TOP + bottom) / 2, 22, self.y_title, anchor="middle", size=13)}</g>']
        for value in self.x.ticks():
            at = self.x.at(value)
            out += [stroke(at, TOP, at, bottom, "#e4e4e4"),
                    text(at, bottom + 18, number(value), anchor="middle")]
        for value in self.y.ticks():
            at = self.y.at(value)
            out += [stroke(LEFT, at, self.right, at, "#e4e4e4"),
                    text(LEFT - 8, at + 4, number(value), anchor="end")]
        out.append(f'<rect x="{LEFT}" y="{TOP}" width="{self.right - LEFT}" '
                   f'height="{bottom - TOP}" fill="none" stroke="#808080"/>')
        return out

    def _drawn_lines(self):
        out, ends = [], []
        for places, colour, name, width, dash, at_end in self.lines:
            corners = " ".join(f"{self.x.at(x):.1f},{self.y.at(y):.1f}" for x, y in places)
            out.append(f'<polyline points="{corners}" fill="none" stroke="{colour}" '
                       f'stroke-width="{width}" stroke-dasharray="{dash}"/>')
            if at_end:
                ends.append((self.x.at(places[-1][0]), self.y.at(places[-1][1]), name, colour))
        return out + self._names_at_ends(sorted(ends, key=lambda end: end[1]))

    def _names_at_ends(self, ends):
        """In one column, moved apart until none lies on another, tied to their lines."""
        rows = [y for _, y, _, _ in ends]
        for i in range(1, len(rows)):
            rows[i] = max(rows[i], rows[i - 1] + LABEL_HEIGHT)
        over = rows[-1] - (HEIGHT - BOTTOM) if rows else 0
        for i in reversed(range(len(rows))):
            limit = rows[i + 1] - LABEL_HEIGHT if i + 1 < len(rows) else rows[i] - max(over, 0)
            rows[i] = min(rows[i], limit)
        out = []
        for (x, y, name, colour), row in zip(ends, rows):
            out += [stroke(x + 6, y, self.right + 24, row, colour, 0.6),
                    text(self.right + 28, row + 4, name, colour=colour)]
        return out

    def _drawn_points(self):
        out, taken = [], [box for line in self.lines for box in self._boxes_along(line[0])]
        for x, y, colour, _, radius, hollow in self.points:
            at = self.x.at(x), self.y.at(y)
            taken.append((at[0] - radius, at[1] - radius, at[0] + radius, at[1] + radius))
            out.append(f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{radius}" stroke="{colour}" '
                       f'fill="{"white" if hollow else colour}"/>')
        for x, y, colour, label, radius, _ in self.points:
            if label:
                out += self._label(self.x.at(x), self.y.at(y), radius, label, colour, taken)
        return out

    def _boxes_along(self, places):
        """Small ones, close enough together that no label fits on the line."""
        ats = [(self.x.at(x), self.y.at(y)) for x, y in places]
        for (x1, y1), (x2, y2) in zip(ats, ats[1:]):
            steps = math.ceil(math.hypot(x2 - x1, y2 - y1) / 6)
            for i in range(1, steps):
                x, y = x1 + (x2 - x1) * i / steps, y1 + (y2 - y1) * i / steps
                yield x - 1, y - 1, x + 1, y + 1

    def _label(self, x, y, radius, label, colour, taken):
        """At the nearest free place around the point, with a line to it when that is far."""
        width = CHARACTER * len(label)
        for distance in range(0, 160, 6):
            for step in range(8):
                # Right, left, above and below first, then between.
                angle = math.pi / 4 * (0, 4, 6, 2, 7, 5, 1, 3)[step]
                reach = radius + 3 + distance
                centre = (x + math.cos(angle) * (reach + width / 2),
                          y + math.sin(angle) * (reach + LABEL_HEIGHT / 2))
                box = (centre[0] - width / 2, centre[1] - LABEL_HEIGHT / 2,
                       centre[0] + width / 2, centre[1] + LABEL_HEIGHT / 2)
                if self._is_free(box, taken):
                    taken.append(box)
                    tie = stroke(x, y, min(max(x, box[0]), box[2]), min(max(y, box[1]), box[3]),
                                 colour, 0.6)
                    return [tie] * (distance > 0) + [text(centre[0], centre[1] + 4, label,
                                                          anchor="middle", colour=colour)]
        return []  # the table has it

    def _is_free(self, box, taken):
        inside = LEFT < box[0] and box[2] < self.right and TOP < box[1] < box[3] < HEIGHT - BOTTOM
        return inside and all(box[2] <= other[0] or other[2] <= box[0] or
                              box[3] <= other[1] or other[3] <= box[1] for other in taken)


def text(x, y, words, anchor="start", size=11, colour="#202020"):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" '
            f'fill="{colour}">{html.escape(words)}</text>')


def stroke(x1, y1, x2, y2, colour, width=1.0):
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
            f'stroke-width="{width}"/>')
