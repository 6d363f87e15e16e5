// The explicit method of Dormand and Prince of order 8, DOP853, written out for equations that do not contain the time.
//
// Coefficients, error estimate and choice of steps: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential
// Equations I, 2nd revised edition, Springer 1993, sections II.4, II.5 and II.10. Stage sums stand as one expression each, and
// the function is made part of its caller, so that the compiler knows size and equations.

#include <math.h>
#include <stdbool.h>

#define A2_1 5.26001519587677318785587544488e-2
#define A3_1 1.97250569845378994544595329183e-2
#define A3_2 5.91751709536136983633785987549e-2
#define A4_1 2.95875854768068491816892993775e-2
#define A4_3 8.87627564304205475450678981324e-2
#define A5_1 2.41365134159266685502369798665e-1
#define A5_3 -8.84549479328286085344864962717e-1
#define A5_4 9.24834003261792003115737966543e-1
#define A6_1 3.7037037037037037037037037037e-2
#define A6_4 1.70828608729473871279604482173e-1
#define A6_5 1.25467687566822425016691814123e-1
#define A7_1 3.7109375e-2
#define A7_4 1.70252211019544039314978060272e-1
#define A7_5 6.02165389804559606850219397283e-2
#define A7_6 -1.7578125e-2
#define A8_1 3.70920001185047927108779319836e-2
#define A8_4 1.70383925712239993810214054705e-1
#define A8_5 1.07262030446373284651809199168e-1
#define A8_6 -1.53194377486244017527936158236e-2
#define A8_7 8.27378916381402288758473766002e-3
#define A9_1 6.24110958716075717114429577812e-1
#define A9_4 -3.36089262944694129406857109825
#define A9_5 -8.68219346841726006818189891453e-1
#define A9_6 2.75920996994467083049415600797e1
#define A9_7 2.01540675504778934086186788979e1
#define A9_8 -4.34898841810699588477366255144e1
#define A10_1 4.77662536438264365890433908527e-1
#define A10_4 -2.48811461997166764192642586468
#define A10_5 -5.90290826836842996371446475743e-1
#define A10_6 2.12300514481811942347288949897e1
#define A10_7 1.52792336328824235832596922938e1
#define A10_8 -3.32882109689848629194453265587e1
#define A10_9 -2.03312017085086261358222928593e-2
#define A11_1 -9.3714243008598732571704021658e-1
#define A11_4 5.18637242884406370830023853209
#define A11_5 1.09143734899672957818500254654
#define A11_6 -8.14978701074692612513997267357
#define A11_7 -1.85200656599969598641566180701e1
#define A11_8 2.27394870993505042818970056734e1
#define A11_9 2.49360555267965238987089396762
#define A11_10 -3.0467644718982195003823669022
#define A12_1 2.27331014751653820792359768449
#define A12_4 -1.05344954667372501984066689879e1
#define A12_5 -2.00087205822486249909675718444
#define A12_6 -1.79589318631187989172765950534e1
#define A12_7 2.79488845294199600508499808837e1
#define A12_8 -2.85899827713502369474065508674
#define A12_9 -8.87285693353062954433549289258
#define A12_10 1.23605671757943030647266201528e1
#define A12_11 6.43392746015763530355970484046e-1
#define B_1 5.42937341165687622380535766363e-2
#define B_6 4.45031289275240888144113950566e0
#define B_7 1.89151789931450038304281599044e0
#define B_8 -5.8012039600105847814672114227e0
#define B_9 3.1116436695781989440891606237e-1
#define B_10 -1.52160949662516078556178806805e-1
#define B_11 2.01365400804030348374776537501e-1
#define B_12 4.47106157277725905176885569043e-2
#define B3_1 0.244094488188976377952755905512
#define B3_9 0.733846688281611857341361741547
#define B3_12 0.220588235294117647058823529412e-1
#define E5_1 0.1312004499419488073250102996e-1
#define E5_6 -0.1225156446376204440720569753e+1
#define E5_7 -0.4957589496572501915214079952
#define E5_8 0.1664377182454986536961530415e+1
#define E5_9 -0.3503288487499736816886487290
#define E5_10 0.3341791187130174790297318841
#define E5_11 0.8192320648511571246570742613e-1
#define E5_12 -0.2235530786388629525884427845e-1

#define MOST 24
#define MOST_STEPS 10000000L

typedef void (*Equations)(const double *restrict y, double *restrict f);

// Root of the mean of squares, each over its tolerance.
static inline __attribute__((always_inline)) double norm(const double *v, const double *y, double tolerance, int size) {
    double sum = 0;
    for (int i = 0; i < size; i++) {
        const double part = v[i] / (tolerance * (1 + fabs(y[i])));
        sum += part * part;
    }
    return sqrt(sum / size);
}

static inline __attribute__((always_inline)) double first_step(Equations rhs, const double *y, const double *k1, double t_end,
                                                               double tolerance, int size) {
    const double slope = norm(k1, y, tolerance, size), state = norm(y, y, tolerance, size);
    double h = slope <= 1e-5 || state <= 1e-5 ? 1e-6 : 0.01 * state / slope;
    h = fmin(h, t_end);
    double next[MOST], k2[MOST], change[MOST];
    for (int i = 0; i < size; i++) next[i] = y[i] + h * k1[i];
    rhs(next, k2);
    for (int i = 0; i < size; i++) change[i] = k2[i] - k1[i];
    const double curvature = norm(change, y, tolerance, size) / h;
    const double most = fmax(curvature, slope);
    const double wanted = most <= 1e-15 ? fmax(1e-6, 1e-3 * h) : pow(0.01 / most, 1.0 / 8.0);
    return fmin(fmin(100 * h, wanted), t_end);
}

// Carries y from 0 to t_end; the number of evaluations, or -1.
static inline __attribute__((always_inline)) long dop853(Equations rhs, double *restrict y, double t_end, double tolerance,
                                                         const int size) {
    double k1[MOST], k2[MOST], k3[MOST], k4[MOST], k5[MOST], k6[MOST], k7[MOST], k8[MOST], k9[MOST], k10[MOST], k11[MOST], k12[MOST];
    double s[MOST], next[MOST];
    rhs(y, k1);
    double t = 0, h = first_step(rhs, y, k1, t_end, tolerance, size);
    long evaluations = 2;
    bool rejected = false;
    for (long step = 0; step < MOST_STEPS; step++) {
        const bool last = t + 1.01 * h >= t_end;
        if (last) h = t_end - t;
        if (0.1 * h <= t * 2.3e-16) return -1;
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A2_1 * k1[i]);
        rhs(s, k2);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A3_1 * k1[i] + A3_2 * k2[i]);
        rhs(s, k3);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A4_1 * k1[i] + A4_3 * k3[i]);
        rhs(s, k4);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A5_1 * k1[i] + A5_3 * k3[i] + A5_4 * k4[i]);
        rhs(s, k5);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A6_1 * k1[i] + A6_4 * k4[i] + A6_5 * k5[i]);
        rhs(s, k6);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A7_1 * k1[i] + A7_4 * k4[i] + A7_5 * k5[i] + A7_6 * k6[i]);
        rhs(s, k7);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A8_1 * k1[i] + A8_4 * k4[i] + A8_5 * k5[i] + A8_6 * k6[i] + A8_7 * k7[i]);
        rhs(s, k8);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A9_1 * k1[i] + A9_4 * k4[i] + A9_5 * k5[i] + A9_6 * k6[i] + A9_7 * k7[i] + A9_8 * k8[i]);
        rhs(s, k9);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A10_1 * k1[i] + A10_4 * k4[i] + A10_5 * k5[i] + A10_6 * k6[i] + A10_7 * k7[i] + A10_8 * k8[i] + A10_9 * k9[i]);
        rhs(s, k10);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A11_1 * k1[i] + A11_4 * k4[i] + A11_5 * k5[i] + A11_6 * k6[i] + A11_7 * k7[i] + A11_8 * k8[i] + A11_9 * k9[i] + A11_10 * k10[i]);
        rhs(s, k11);
        for (int i = 0; i < size; i++) s[i] = y[i] + h * (A12_1 * k1[i] + A12_4 * k4[i] + A12_5 * k5[i] + A12_6 * k6[i] + A12_7 * k7[i] + A12_8 * k8[i] + A12_9 * k9[i] + A12_10 * k10[i] + A12_11 * k11[i]);
        rhs(s, k12);
        double sum5 = 0, sum3 = 0;
        for (int i = 0; i < size; i++) {
            const double slope = B_1 * k1[i] + B_6 * k6[i] + B_7 * k7[i] + B_8 * k8[i] + B_9 * k9[i] + B_10 * k10[i] + B_11 * k11[i] + B_12 * k12[i];
            next[i] = y[i] + h * slope;
            const double scale = 1 / (tolerance * (1 + fmax(fabs(y[i]), fabs(next[i]))));
            const double e3 = (slope - B3_1 * k1[i] - B3_9 * k9[i] - B3_12 * k12[i]) * scale;
            const double e5 = (E5_1 * k1[i] + E5_6 * k6[i] + E5_7 * k7[i] + E5_8 * k8[i] + E5_9 * k9[i] + E5_10 * k10[i] + E5_11 * k11[i] + E5_12 * k12[i]) * scale;
            sum3 += e3 * e3;
            sum5 += e5 * e5;
        }
        evaluations += 11;
        const double both = sum5 + 0.01 * sum3;
        const double error = h * sum5 * sqrt(1 / (size * (both > 0 ? both : 1)));
        // 1/6 to 1/0.333 of the step at most, 0.9 for safety.
        const double shorter = fmax(1.0 / 6.0, fmin(1.0 / 0.333, pow(error, 1.0 / 8.0) / 0.9));
        if (error >= 1) {
            h /= fmin(1.0 / 0.333, pow(error, 1.0 / 8.0) / 0.9);
            rejected = true;
            continue;
        }
        if (!(error < 1)) return -1;
        t += h;
        for (int i = 0; i < size; i++) y[i] = next[i];
        if (last) return evaluations;
        rhs(y, k1);
        evaluations++;
        h /= rejected ? fmax(1, shorter) : shorter;
        rejected = false;
    }
    return -1;
}
