"""What [Vanecek05 §7.3, §8] publishes about stripifiers, and the bars `best` is held to."""

# Label there: the algorithm here, its variant, and why it may differ (the headers in
# codecs/stripify say more).
LABELS = {
    "SGS": ("sgi-strips", "", "ties left open: ours by the latest touched triangle, lowest edge"),
    "SGV": ("sgi-vertices", "", "ties left open: ours by the latest touched triangle, lowest edge"),
    "MSS": ("mstrip", "strips",
            "no more known than “concurrently”: both ends grow, dead ends are linked"),
    "MSV": ("mstrip", "indices",
            "no more known than “concurrently”: both ends grow, dead ends are linked"),
    "STS": ("stripe-lookahead", "topological",
            "the thesis suspects a fault in the program it measured"),
    "STV": ("stripe-noswap", "topological",
            "local rule restated: a strip grows from its start both ways"),
    "FTS": ("ftsg-sgi", "", "known by the thesis' summary alone: order of search and details ours"),
    "FTV": ("ftsg-alt", "", "known by the thesis' summary alone: order of search and details ours"),
    "TUS": ("tunneling", "", "a step that closes a ring is not taken: every tunnel can be dug"),
    "MPS": ("multi-path", "", "order within a class left open: ours first in, first out"),
    "EMS": ("multi-path-weighted", "axis",
            "weight left open: ours the largest x of the corners, in buckets"),
}


def by_label(*columns):
    return dict(zip(LABELS, zip(*columns)))


# Strips, thousands of vertices, ACMR 16, seconds on a Pentium 4 of 2.8 GHz.
# [Vanecek05 tables 8.3, 8.2, 8.6, 8.7]
REAL_MODELS = {
    "cow": by_label((98, 352, 78, 127, 141, 136, 105, 312, 19, 17, 16),
                    (8, 7, 8, 7, 9, 7, 7, 7, 8, 8, 8),
                    (.83, .98, .85, .95, .80, .92, .92, 1.03, .78, .81, .83),
                    (.05, .02, .01, .01, .20, .22, .02, .02, .64, .03, .03)),
    "bunny": by_label((648, 3560, 575, 1174, 1531, 1229, 618, 3238, 166, 154, 86),
                      (87, 82, 86, 82, 102, 83, 85, 82, 99, 94, 86),
                      (.90, .99, .92, .99, .82, .96, .97, 1.03, .81, .87, .90),
                      (.38, .14, .19, .19, 2.36, 2.40, .27, .28, 101.72, .40, .67)),
}

# Strips of a torus of 20 x N. [Vanecek05 table 8.9]; where it has none: None
TORUS = {
    20: (1, 19, 2, 17, 19, 1, 1, 19, 1, 1, 1),
    50: (1, 19, 2, 19, 40, 1, 1, 9, 1, 1, 1),
    100: (1, 19, 2, 19, 87, 1, 1, 19, 1, 1, 1),
    200: (1, 19, 2, 19, 162, 1, 1, 19, 1, 1, 1),
    500: (1, 19, None, None, 397, 1, 1, 19, 1, 1, 1),
}

# Strips of bunny after so many random edge swaps. [Vanecek05 table 8.12]
FLIPS = {
    0: (648, 3560, 573, 1173, 1531, 1229, 618, 3238, 166, 154, 88),
    10_000: (1143, 5626, 1117, 1749, 1655, 1816, 1417, 4555, 225, 325, 242),
    20_000: (1520, 6206, 1414, 1879, 1861, 2014, 1815, 5044, 290, 490, 430),
    30_000: (1644, 6537, 1590, 1975, 2048, 2101, 2059, 5140, 346, 639, 605),
}

# Quads, strips of STRIPE, of QStrip. [Vanecek05 table 7.1]
QUADS = [(2114, 88, 4), (4002, 111, 33), (8236, 140, 8), (12588, 391, 32), (16290, 393, 37),
         (25714, 570, 49), (36266, 817, 44), (42005, 1356, 102)]

# Goal, effort: model: the most strips, or indices sent a triangle, that `best` may need.
BARS = {
    ("indices", "fast"): {"bunny": 1.21, "horse": 1.245, "igea": 1.245},
    ("indices", "high"): {"cow": 1.215, "bunny": 1.13, "horse": 1.16, "igea": 1.19,
                          "rocker-arm": 1.245, "nefertiti": 1.27},
    ("indices", "max"): {"cow": 1.203, "bunny": 1.11, "horse": 1.14, "igea": 1.15,
                         "rocker-arm": 1.233, "nefertiti": 1.25},
    ("strips", "max"): {"cow": 1, "bunny": 8, "horse": 5, "igea": 5, "rocker-arm": 2,
                        "nefertiti": 4},
}
FAST_TIME_BAR = 1.5  # of meshoptimizer's, at effort fast
BOTH_BAR = (24, 1.24)  # strips and indices a triangle at once, bunny
QUAD_BAR = 10  # times fewer strips than STRIPE
