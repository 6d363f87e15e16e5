#!/usr/bin/env bash
# The corpus to start from, one specification a file: those of the snapshots, the energies of the table of potentials, and
# phrases that neither has.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
mkdir -p corpus/expand
for snapshot in ../../../tests/snapshots/*.snap ../../../tests/snapshots/equations/*.snap; do
    args=$(sed -n 's/^description: "\(.*\)"$/\1/p' "$snapshot" | sed 's/\\"/"/g')
    item=$(sed -n '/^pub struct/,/[;}]$/{p;/[;}]$/q}' "$snapshot" | tr '\n' ' ')
    printf '%s\n%s' "$args" "$item" > "corpus/expand/$(basename "$snapshot" .snap)"
done
sed -n 's/^    \([a-z0-9_]*\): (\([23]\), \((.*)\), \(.*\))[;]\{0,1\}$/\1|dim = \2, kinetic\3, potential = \4/p' \
    ../../../tests/potentials/energies.rs |
    while IFS='|' read -r name args; do
        printf '%s' "$args" > "corpus/expand/energy_$name"
    done
count=0
while IFS='|' read -r dim potential; do
    count=$((count + 1))
    for chart in "dalembert = 1, space_translation = 2" "casimir2 = a, body_inertia = 1" "space_inertia = b"; do
        args="dim = $dim, kinetic($chart), potential = $potential"
        printf '%s' "$args" > "corpus/expand/phrase_${count}_${chart%% *}"
    done
done <<'PHRASES'
3|0.5*(tr(G)*det^(-2/3) - 3) + 2*(det - 1)^2
3|(tr(G)*I3^(-1/3) - 3)^3 + a*(I2*I3^(-2/3) - 3)
2|tr(G)*I2^(-1/2) + D^0.5*tr(G)
3|tr(G^2) - 2*tr(G) + tr(G^3*Ct^2)
2|Q1^1.3 + Q2^1.3 + pairs(cosh(d))
3|pairs(d^2) + Q1^1.3 + Q2^1.3 + Q3^1.3
2|((tr(G) - 2)^2 + q^2 + 0.1)^3 + ln(2 + (det - 1)^2)
3|(G[1,1] - 1)^4*(Ct[1,2] + phi[3,1])^2 + (tr(G) - 3)^2/(1 + (q + 0.1)^2)
3|sin(3*t)*tr(G)/(2 + cos(t)) + tanh(q)^2 + sinh(q)^2
3|tr((G - 1)^2)/4 + a*tr(G^-1) + log1p(q^2) + expm1(b*(tr(G) - 3))
2|tr((G - tr(G)/n)^2)*tr(Ct^-1) + tr((phi - 1)*(2*G - a*Ct)) + log(det)^2
3|ln(1 + I2^2) + sqrt(1 + (I2 - 3)^2) + abs(tr(G))^3
3|(Q1 + Q2 + Q3)^2*pairs(sqrt(1 + d^2)) + ln((1 + Q1)*(1 + Q2)*(1 + Q3))
2|neo_hookean(a) + saint_venant_kirchhoff(1, b) + gas(0.1)
3|tr((G + Ct)^5) + (tr((G*Ct - a)^3) - 2)^2 + tr(phi*(G + b)^2*phi)
PHRASES
