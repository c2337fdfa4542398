"""Codes of the compact profile: varints, runs and the models that learn (compact.md 1 and 4)."""

from model import require

SHARES = 1 << 15


def length(n):
    """len(n): the number of bits of n."""
    return n.bit_length()


def half_steps(n):
    """H(n): the logarithm of n in half steps."""
    if n < 2:
        return 0
    l = length(n) - 1
    return 2 * l + (n >> (l - 1) & 1)


def toward_zero(x, y):
    """x / y without its fraction; y is positive."""
    return x // y if x >= 0 else -(-x // y)


def read_varint(payload, bound=1 << 32):
    """A varint of a payload's head, below a bound (compact.md 4, K-003)."""
    value = 0
    shift = 0
    while True:
        byte = payload.u8()
        value |= (byte & 0x7F) << shift
        require(value < bound, "K-003")
        shift += 7
        if byte < 0x80:
            require(byte != 0 or shift == 7, "K-003")
            return value


class Run:
    """The rest of a payload (compact.md 4)."""

    def __init__(self, data):
        require(len(data) % 2 == 0, "K-004")
        self.words = [data[i] | data[i + 1] << 8 for i in range(0, len(data), 2)]
        self.at = 0
        self.x = self.word() << 16
        self.x |= self.word()

    def word(self):
        require(self.at < len(self.words), "K-004")
        self.at += 1
        return self.words[self.at - 1]

    def share(self):
        """Which of the shares the next code's interval holds."""
        return self.x % SHARES

    def take(self, a, w):
        """Leaves the code with the interval [a, a + w) behind."""
        self.x = w * (self.x // SHARES) + self.x % SHARES - a
        if self.x < 1 << 16:
            self.x = self.x << 16 | self.word()

    def raw(self, bits):
        value = 0
        for low in range(0, bits, 12):
            n = min(12, bits - low)
            p = self.share() >> (15 - n)
            self.take(p << (15 - n), 1 << (15 - n))
            value |= p << low
        return value

    def choice(self, weights):
        """Which of the things with these weights it is, and the shares of each."""
        n = len(weights)
        f = ((SHARES - n) << 16) // sum(weights)
        shares = [1 + (weight * f >> 16) for weight in weights[:-1]]
        shares.append(SHARES - sum(shares))
        a = 0
        for i, w in enumerate(shares):
            if self.share() < a + w:
                self.take(a, w)
                return i, shares
            a += w

    def end(self):
        require(self.at == len(self.words) and self.x == 1 << 16, "K-004")


def rate(first, bounds, m):
    """r: first for m below the first bound, one more for each bound that m has come to."""
    return first + sum(m >= bound for bound in bounds)


class BitModel:
    def __init__(self):
        self.z = 1 << 14
        self.m = 0

    def read(self, run):
        bit = int(run.share() >= self.z)
        if bit:
            run.take(self.z, SHARES - self.z)
        else:
            run.take(0, self.z)
        r = rate(3, (8, 24, 60), self.m)
        if bit:
            self.z -= (self.z - 32) >> r
        else:
            self.z += (SHARES - 32 - self.z) >> r
        self.m = min(self.m + 1, 60)
        return bit


class SymbolModel:
    def __init__(self):
        self.t = [i << 11 for i in range(17)]  # t[16] stays
        self.m = 0

    def read(self, run):
        symbol = max(i for i in range(16) if self.t[i] <= run.share())
        run.take(self.t[symbol], self.t[symbol + 1] - self.t[symbol])
        r = rate(2, (4, 10, 20, 50, 120), self.m)
        for i in range(16):
            g = i if i <= symbol else i + SHARES - 16
            self.t[i] += (g - self.t[i]) >> r
        self.m = min(self.m + 1, 120)
        return symbol

    def read_count(self, run, raw_bits):
        """A symbol, 15 of which says that it is 15 + raw bits."""
        symbol = self.read(run)
        return symbol if symbol < 15 else 15 + run.raw(raw_bits)


def read_second_and_third(run, l, models):
    """The three highest bits of a magnitude of l bits, of which the first is a one."""
    high = 1
    if l > 1:
        high = 2 | models[0].read(run)
    if l > 2:
        high = high << 1 | models[1 + (high & 1)].read(run)
    return high


class NumberModel:
    def __init__(self):
        self.lengths = SymbolModel()
        self.bits = [[BitModel() for _ in range(3)] for _ in range(16)]

    def read(self, run):
        l = self.lengths.read_count(run, 4)
        if l == 0:
            return 0
        magnitude = read_second_and_third(run, l, self.bits[min(l, 15)])
        others = max(l - 3, 0)
        magnitude = magnitude << others | run.raw(others)
        return -magnitude if run.raw(1) else magnitude


class ScaledNumberModel:
    def __init__(self):
        self.lengths = [SymbolModel() for _ in range(32)]
        # For each h, for l 2 and for others.
        self.bits = [[[BitModel() for _ in range(3)] for _ in range(2)] for _ in range(32)]

    def read(self, run, q):
        l = self.lengths[min(q // 3, 31)].read_count(run, 4)
        if l == 0:
            return 0
        h = min(max(4 * l + 40 - q, 0) // 4, 31)
        magnitude = read_second_and_third(run, l, self.bits[h][l != 2])
        others = max(l - 3, 0)
        rest = run.raw(others + 1)
        magnitude = magnitude << others | rest >> 1
        return -magnitude if rest & 1 else magnitude


class Models(dict):
    """Models by what they are for, each made when it is first used."""

    def __init__(self, kind):
        super().__init__()
        self.kind = kind

    def __missing__(self, key):
        self[key] = self.kind()
        return self[key]
