"""Reference values for tests/two_polar.rs: python3 two_polar.py > two_polar.csv (mpmath 1.3).

Entries of phi are doubles, taken exactly; the stretches are its singular values, descending, each as the sum of two
doubles. Squares of stretches are roots of the characteristic polynomial of phi^T phi, by mpmath's symmetric
eigenvalues with 1400 digits, which is enough for stretches that differ by a factor of 1e260.
"""

import random

from mpmath import eigsy, exp, matrix, mp, mpf, qr, sqrt

mp.dps = 60
random.seed(1958)

print(f"# {__doc__.strip()}".replace("\n", "\n# ").replace("# \n", "#\n"))
print("# n, kind, entries of phi row by row, high and low part of every stretch")


def determinant(m):
    if m.rows == 2:
        return m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    return sum(
        m[0, j] * (m[1, (j + 1) % 3] * m[2, (j + 2) % 3] - m[1, (j + 2) % 3] * m[2, (j + 1) % 3]) for j in range(3)
    )


def normal(n):
    return matrix([[random.gauss(0, 1) for _ in range(n)] for _ in range(n)])


def rotation(n):
    q, r = qr(normal(n))
    for a in range(n):
        if r[a, a] < 0:
            q[:, a] = -q[:, a]
    if determinant(q) < 0:
        q[:, 0] = -q[:, 0]
    return q


def diagonal(values):
    return matrix([[values[a] if a == b else mpf(0) for b in range(len(values))] for a in range(len(values))])


def stretched(stretches):
    n = len(stretches)
    return rotation(n) * diagonal(stretches) * rotation(n).T


def conditioned(n):
    """A random matrix with a condition number of at most 4."""
    return stretched([mpf(random.uniform(0.5, 2)) for _ in range(n)])


def grades(n, octaves):
    list_ = [mpf(2) ** random.uniform(-octaves, octaves) for _ in range(n)]
    random.shuffle(list_)
    return diagonal(list_)


def cases(n):
    for _ in range(60):
        yield "random", normal(n)
    for octaves in [8, 30, 100, 300, 430]:
        for _ in range(6):
            yield "rows graded", grades(n, octaves) * conditioned(n)
            yield "columns graded", conditioned(n) * grades(n, octaves)
    for k in range(1, 16):
        for _ in range(3):
            small = [mpf(random.uniform(0.5, 2)) for _ in range(n - 1)] + [mpf(10) ** -k]
            yield "nearly singular", stretched(small)
    for k in range(0, 17):
        for _ in range(3):
            one = mpf(random.uniform(0.5, 2))
            yield "nearly coincident", stretched([one, one * (1 + mpf(10) ** -k)] + [mpf("0.3")] * (n - 2))
            yield "all nearly coincident", stretched([one * (1 + a * mpf(10) ** -k) for a in range(n)])
    for power in [-1000, -40, 0, 3, 1000]:
        scale = mpf(2) ** power
        yield "coincident", matrix([[scale if a == b else mpf(0) for b in range(n)] for a in range(n)])
        turn = matrix([[mpf(0)] * n for _ in range(n)])
        turn[0, 1], turn[1, 0] = -scale, scale
        for a in range(2, n):
            turn[a, a] = scale
        yield "coincident", turn
        # (3, 4, 5) and (1, 2, 2, 3): orthogonal but for an integer factor.
        if n == 2:
            yield "coincident", matrix([[3, -4], [4, 3]]) * scale
        else:
            yield "coincident", matrix([[1, 2, 2], [2, 1, -2], [2, -2, 1]]) * (-scale)
            yield "two coincident", matrix([[3, -4, 0], [4, 3, 0], [0, 0, 7]]) * scale
    for _ in range(10):
        yield "far apart", stretched([exp(300), exp(299), exp(298)][:n])
        yield "far apart", grades(n, 430)
        yield "far apart", stretched([exp(-300), exp(-299), exp(-298)][:n])


def doubles(value):
    high = float(value)
    return [repr(high), repr(float(value - mpf(high)))]


for n in (2, 3):
    for kind, exact in cases(n):
        phi = exact.apply(lambda entry: mpf(float(entry)))
        mp.dps = 1400
        if determinant(phi) <= 0:
            phi[0, :] = -phi[0, :]
        stretches = sorted([sqrt(value) for value in eigsy(phi.T * phi, eigvals_only=True)], reverse=True)
        product = mpf(1)
        for value in stretches:
            product *= value
        det = determinant(phi)
        mp.dps = 60
        if det <= 0:
            continue
        assert abs(product / det - 1) < mpf(10) ** -50, (kind, phi)
        entries = [repr(float(phi[a, b])) for a in range(n) for b in range(n)]
        print(n, kind, *entries, *sum((doubles(value) for value in stretches), []), sep=",")
