"""Reference values for tests/kinematics.rs: python3 kinematics.py > kinematics.txt (mpmath 1.3, 60 digits).

Inputs are doubles, taken exactly; every other line follows from them by the definitions of section 2 of
Slawianowski et al., evaluated with mpmath, inverses and determinants included, and is printed to 25 digits.
"""

import random

from mpmath import exp, eye, inverse, log, matrix, mp, mpf, nstr, svd_r

mp.dps = 60
random.seed(2004)

print(f"# {__doc__.strip()}".replace("\n", "\n# ").replace("# \n", "#\n"))
print("# 'case NAME n', then one line per quantity: name and entries, row-major.")


def show(name, value):
    if isinstance(value, matrix):
        value = [value[i, j] for i in range(value.rows) for j in range(value.cols)]
    elif not isinstance(value, list):
        value = [value]
    print(name, *(repr(v) if isinstance(v, float) else nstr(v, 25) for v in value))


def det(m):
    """Leibniz' sum: mpmath's own det calls a graded matrix singular."""
    if m.rows == 2:
        return m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    return sum(
        m[0, j] * (m[1, (j + 1) % 3] * m[2, (j + 2) % 3] - m[1, (j + 2) % 3] * m[2, (j + 1) % 3]) for j in range(3)
    )


def tr(m):
    return sum(m[i, i] for i in range(m.rows))


def dev(m):
    return m - tr(m) / m.rows * eye(m.rows)


def elementary(v):
    """Elementary symmetric functions e1..en."""
    e = [mpf(1)] + [mpf(0)] * len(v)
    for x in v:
        for k in range(len(v), 0, -1):
            e[k] += x * e[k - 1]
    return e[1:]


def case(name, entries):
    n = len(entries)
    phi = matrix(n, n)
    for i in range(n):
        for j in range(n):
            phi[i, j] = mpf(entries[i][j])
    assert det(phi) > 0
    print("case", name, n)
    show("phi", [v for row in entries for v in row])
    return n, phi


def dilatation(n, phi):
    q = log(det(phi)) / n
    show("q", q)
    show("D", exp(q))
    show("Psi", exp(-q) * phi)


def deformation(n, phi):
    stretches = [s for s in svd_r(phi, compute_uv=False)]
    show("condition", max(stretches) / min(stretches))
    g, gi = phi.T * phi, inverse(phi) * inverse(phi).T
    c, ci = inverse(phi).T * inverse(phi), phi * phi.T
    for label, value in [("G", g), ("G_inverse", gi), ("C", c), ("C_inverse", ci)]:
        show(label, value)
    show("E", (g - eye(n)) / 2)
    show("e", (eye(n) - c) / 2)
    show("G_powers", [tr(g**k) for k in range(1, n + 1)])
    show("C_powers", [tr(c**k) for k in range(1, n + 1)])
    show("invariants", elementary([s**2 for s in stretches]))
    j = [[random.uniform(-1, 1) for _ in range(n)] for _ in range(n)]
    j = [[(2.0 if a == b else 0.0) + j[min(a, b)][max(a, b)] for b in range(n)] for a in range(n)]
    show("J", [v for row in j for v in row])
    show("J_phi", phi * matrix(j) * phi.T)


def motion(n, phi):
    def draw(rows, cols):
        values = [random.uniform(-2, 2) for _ in range(rows * cols)]
        return values, matrix(rows, cols) + matrix([values[r * cols : (r + 1) * cols] for r in range(rows)])

    named = {}
    for label, cols in [("phi_dot", n), ("Pi", n), ("x", 1), ("x_dot", 1), ("p", 1)]:
        values, named[label] = draw(n, cols)
        show(label, values)
    phi_dot, pi, x, x_dot, p = named.values()
    inv = inverse(phi)
    om, oh = phi_dot * inv, inv * phi_dot
    sig, sh = phi * pi, pi * phi
    spin, vort, lam = sig - sig.T, sh - sh.T, x * p.T
    for label, value in [
        ("Omega", om), ("Omega_hat", oh), ("v_hat", inv * x_dot), ("p_hat", phi.T * p),
        ("q_dot", tr(om) / n), ("omega", dev(om)), ("omega_hat", dev(oh)),
        ("Sigma", sig), ("Sigma_hat", sh), ("sigma", dev(sig)), ("sigma_hat", dev(sh)),
        ("S", spin), ("V", vort), ("S_norm2", -tr(spin**2) / 2), ("V_norm2", -tr(vort**2) / 2),
        ("Lambda", lam), ("L", lam - lam.T), ("I", lam + sig), ("Jtot", lam - lam.T + spin),
        ("pairing", tr(pi * phi_dot)), ("pairing_x", (p.T * x_dot)[0]),
        ("casimirs", [tr(sig**k) for k in range(1, n + 1)]),
        ("shear_casimirs", [tr(dev(sig) ** k) for k in range(1, n + 1)]),
    ]:
        show(label, value)


def uniform(n, scale, shift):
    while True:
        m = [[scale * random.uniform(-1, 1) + (shift if i == j else 0.0) for j in range(n)] for i in range(n)]
        if det(matrix(m)) > 0.1 * scale**n:
            return m


for n in (2, 3):
    for k in range(6):
        n, phi = case(f"random{k}", uniform(n, 1.0, 1.0))
        dilatation(n, phi), deformation(n, phi), motion(n, phi)
    for digits in (3, 6, 9, 12):
        n, phi = case(f"nearly_undeformed_1e-{digits}", uniform(n, 10.0**-digits, 1.0))
        dilatation(n, phi), deformation(n, phi), motion(n, phi)

# Rows and columns of a well-conditioned matrix times powers of ten: stretches from 1e-150 to 1e150.
GRADES = {
    2: [([0, 0], [150, -150]), ([150, -150], [0, 0]), ([75, -75], [-75, 75]), ([-150, -140], [0, 1]),
        ([150, 150], [0, 0])],
    3: [([0, 0, 0], [150, 0, -150]), ([-150, 150, 10], [0, 0, 0]), ([-75, 75, 3], [75, -75, 20]),
        ([103, 103, 103], [0, 0, 0]), ([-110, -110, -110], [0, 0, 0]), ([150, 150, 150], [0, 0, 0]),
        ([-150, -150, -150], [0, 0, 0]), ([150, -150, -150], [0, 0, 0])],
}
for n, grades in GRADES.items():
    for k, (rows, cols) in enumerate(grades):
        w = uniform(n, 1.0, 1.0)
        m = [[w[i][j] * float(f"1e{rows[i] + cols[j]}") for j in range(n)] for i in range(n)]
        dilatation(*case(f"graded{k}", m))
