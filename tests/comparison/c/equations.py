#!/usr/bin/env python3
"""Writes equations.h: the benchmark problems as C, with common subexpressions taken out by SymPy and by CasADi.

The equations are stated as well as can be done by hand: [S, O] is d [S, S^T], since O is a sum of S, S^T and the unit
matrix; symmetric matrices are computed once; inverses are cofactors; powers of det phi come from one cube root.

    python3 -m venv tools && tools/bin/pip install sympy==1.14.0 casadi==3.8.2
    tools/bin/python equations.py > equations.h
"""

import casadi
import sympy

A, B = 0.2, 0.1
ALPHA = 1.0 + A
SHEAR, TRACE, SKEW = 1.0 / ALPHA, -B / (ALPHA * (ALPHA + 3.0 * B)), 1.0 / (1.0 - A * A)
P = (0.3, -0.2, 0.5)
JHAT = (1.0, 1.5, 2.0)


def matrix(y, at):
    """Column by column."""
    return [[y[at + 3 * j + i] for j in range(3)] for i in range(3)]


def product(a, b):
    return [[a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] for j in range(3)] for i in range(3)]


def transposed(a):
    return [[a[j][i] for j in range(3)] for i in range(3)]


def symmetric(entry):
    """Each entry is stated once."""
    upper = {(i, j): entry(i, j) for i in range(3) for j in range(i, 3)}
    return [[upper[min(i, j), max(i, j)] for j in range(3)] for i in range(3)]


def square(a):
    """a a^T."""
    return symmetric(lambda i, j: a[i][0] * a[j][0] + a[i][1] * a[j][1] + a[i][2] * a[j][2])


def columns(*matrices):
    return [a[i][j] for a in matrices for j in range(3) for i in range(3)]


def velocity(spin):
    trace = TRACE * (spin[0][0] + spin[1][1] + spin[2][2])
    off = lambda i, j: (SHEAR - SKEW) * spin[i][j] + SKEW * spin[j][i]
    return [[SHEAR * spin[i][i] + trace if i == j else off(i, j) for j in range(3)] for i in range(3)]


def commutator(a):
    """[a, a^T] times the coefficient of S^T in the velocity."""
    left, right = square(a), square(transposed(a))
    return symmetric(lambda i, j: SKEW * (left[i][j] - right[i][j]))


def cofactors(a):
    """The transposed adjugate, and the determinant."""
    c = [[a[(i + 1) % 3][(j + 1) % 3] * a[(i + 2) % 3][(j + 2) % 3]
          - a[(i + 1) % 3][(j + 2) % 3] * a[(i + 2) % 3][(j + 1) % 3] for j in range(3)] for i in range(3)]
    return c, a[0][0] * c[0][0] + a[0][1] * c[0][1] + a[0][2] * c[0][2]


def stress(tensor, phi, kappa, c1, cbrt):
    """-(dU/dphi)^T phi of kappa/2 sinh(q)^2 + c1 (tr G e^(-2q) - 3), or of its mirror image."""
    dilatation = cbrt(cofactors(phi)[1])
    up = dilatation * dilatation
    down = 1 / up
    pressure, shear = kappa / 12 * (up - down), -2 * c1 * down
    diagonal = shear * ((tensor[0][0] + tensor[1][1] + tensor[2][2]) / 3) + pressure
    return symmetric(lambda i, j: shear * tensor[i][j] - (diagonal if i == j else 0))


def added(a, b):
    return symmetric(lambda i, j: a[i][j] + b[i][j])


def vibrating(y, kappa, c1, cbrt):
    phi, spin = matrix(y, 0), matrix(y, 9)
    rate = added(commutator(spin), stress(square(transposed(phi)), phi, kappa, c1, cbrt))
    return columns(product(phi, velocity(spin)), rate)


def mirrored(y, kappa, c1, cbrt):
    phi, spin = matrix(y, 0), matrix(y, 9)
    rate = added(commutator(transposed(spin)), stress(square(phi), phi, kappa, c1, cbrt))
    return columns(product(velocity(spin), phi), rate)


def elastic(y, kappa, c1, cbrt):
    phi, momentum = matrix(y, 0), matrix(y, 9)
    cofactor, determinant = cofactors(phi)
    dilatation = cbrt(determinant)
    up = dilatation * dilatation
    down = 1 / up
    trace = sum(entry * entry for row in phi for entry in row)
    slope = (2 * c1 * down / 3 * trace - kappa / 12 * (up - down)) / determinant
    force = [[slope * cofactor[i][j] - 2 * c1 * down * phi[i][j] for j in range(3)] for i in range(3)]
    return columns([[momentum[i][j] * (1 / JHAT[j]) for j in range(3)] for i in range(3)], force)


def moving(y, with_stress):
    phi, spin = matrix(y, 3), matrix(y, 12)
    p_hat = [phi[0][j] * P[0] + phi[1][j] * P[1] + phi[2][j] * P[2] for j in range(3)]
    rate = commutator(spin)
    if with_stress:
        rate = added(rate, with_stress(square(transposed(phi)), phi))
    rate = symmetric(lambda i, j: rate[i][j] - p_hat[i] * p_hat[j])
    centre = [phi[i][0] * p_hat[0] + phi[i][1] * p_hat[1] + phi[i][2] * p_hat[2] for i in range(3)]
    return centre + columns(product(phi, velocity(spin)), rate)


def missile(y, kappa, c1, cbrt):
    return moving(y, None)


def stiff_missile(y, kappa, c1, cbrt):
    return moving(y, lambda tensor, phi: stress(tensor, phi, kappa, c1, cbrt))


PROBLEMS = [("missile", 21, missile), ("vibrating", 18, vibrating), ("mirrored", 18, mirrored),
            ("elastic", 18, elastic), ("stiff_missile", 21, stiff_missile)]
OPERATORS = {casadi.OP_ADD: "{0} + {1}", casadi.OP_SUB: "{0} - {1}", casadi.OP_MUL: "{0} * {1}",
             casadi.OP_DIV: "{0} / {1}", casadi.OP_NEG: "-{0}", casadi.OP_SQ: "{0} * {0}", casadi.OP_INV: "1 / {0}",
             casadi.OP_TWICE: "2 * {0}", casadi.OP_POW: "pow({0}, {1})", casadi.OP_CONSTPOW: "pow({0}, {1})"}


def head(name, tool):
    return (f"static inline __attribute__((always_inline)) void {name}_{tool}(const double *restrict y, double *restrict f,\n"
            f"                                                     const long n, const double kappa, const double c1) {{")


def by_sympy(name, size, equations):
    y, kappa, c1 = sympy.symbols(f"y:{size}"), sympy.Symbol("kappa"), sympy.Symbol("c1")
    root = lambda x: sympy.Function("cbrt")(x)
    shared, slopes = sympy.cse(equations(y, kappa, c1, root), optimizations="basic")
    text = lambda e: sympy.ccode(e, user_functions={"cbrt": "cbrt"})
    read = set().union(*(e.free_symbols for e in [value for _, value in shared] + slopes))
    print(head(name, "sympy"))
    print(f"    const double {', '.join(f'y{k} = y[{k} * n]' for k in range(size) if y[k] in read)};")
    for symbol, value in shared:
        print(f"    const double {symbol} = {text(value)};")
    for k, slope in enumerate(slopes):
        print(f"    f[{k} * n] = {text(slope)};")
    print("    (void)kappa, (void)c1;\n}\n")


def by_casadi(name, size, equations):
    y, kappa, c1 = casadi.SX.sym("y", size), casadi.SX.sym("kappa"), casadi.SX.sym("c1")
    # The one function that CasADi has no name for stands as an input, of which the root is taken before.
    root, taken = casadi.SX.sym("root"), []
    def cbrt(x):
        taken.append(x)
        return root
    slopes = casadi.vertcat(*equations([y[k] for k in range(size)], kappa, c1, cbrt))
    slopes = casadi.cse(slopes)
    print(head(name, "casadi"))
    if taken:
        straight(casadi.Function("d", [y], [taken[0]]), "d", ["y[{} * n]"], ["const double d = {1}"])
        print("    const double root = cbrt(d);")
    of = casadi.Function("f", [y, kappa, c1, root], [slopes])
    straight(of, "w", ["y[{} * n]", "kappa", "c1", "root"], ["f[{0} * n] = {1}"])
    print("    (void)kappa, (void)c1;\n}\n")


def straight(function, prefix, inputs, outputs):
    """The instructions of a CasADi function, each with a name of its own."""
    last, count = {}, 0
    for k in range(function.n_instructions()):
        what, into, of = function.instruction_id(k), function.instruction_output(k), function.instruction_input(k)
        if what == casadi.OP_OUTPUT:
            print(f"    {outputs[into[0]].format(into[1], last[of[0]])};")
            continue
        if what == casadi.OP_INPUT:
            last[into[0]] = inputs[of[0]].format(of[1])
        elif what == casadi.OP_CONST:
            last[into[0]] = repr(function.instruction_constant(k))
        else:
            value = OPERATORS[what].format(*(last[k] for k in of))
            last[into[0]] = f"{prefix}{count}"
            count += 1
            print(f"    const double {last[into[0]]} = {value};")


print(f"// Written by equations.py with SymPy {sympy.__version__} and CasADi {casadi.__version__}.")
print("// Components k of the state and of its rate stand at y[k * n] and f[k * n].\n")
print("#include <math.h>\n")
for problem in PROBLEMS:
    by_sympy(*problem)
    by_casadi(*problem)
