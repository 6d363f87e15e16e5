// Runs and times the benchmark problems, as it is asked on its input, a line each:
//
//   run TOOL PROBLEM TOLERANCE T_END SECONDS STATE   ->  ok LEAST_SECONDS EVALUATIONS STATE
//   rhs TOOL PROBLEM STATE                           ->  ok CHAIN STATE_AFTER_STATE IN_LANES, in nanoseconds
//
// TOOL is whose equations are taken. A run is repeated until SECONDS are over. Where it does not reach its end, and where a line is not understood, the answer is
// `failed`.

#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "equations.h"
#include "dop853.h"

#define STATES 4096
#define BLOCK 64
#define LINKS 4096
#define REPEATS 60
// What comes out may not be left out.
#define KEEP(pointer) __asm__ volatile("" : : "r"(pointer) : "memory")

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static inline __attribute__((always_inline)) double chain(Equations rhs, const double *start, int size) {
    double y[MOST], f[MOST];
    memcpy(y, start, size * sizeof *y);
    KEEP(y);
    const double begun = now();
    for (int link = 0; link < LINKS; link++) {
        rhs(y, f);
        for (int i = 0; i < size; i++) y[i] += 1e-12 * f[i];
    }
    KEEP(y);
    return (now() - begun) / LINKS;
}

static double states[STATES * MOST], rates[STATES * MOST];

static inline __attribute__((always_inline)) double throughput(Equations rhs, const double *start, int size) {
    for (int k = 0; k < STATES; k++) memcpy(states + k * size, start, size * sizeof *start);
    KEEP(states);
    const double begun = now();
    for (int k = 0; k < STATES; k++) rhs(states + k * size, rates + k * size);
    KEEP(rates);
    return (now() - begun) / STATES;
}

// A block that the nearest cache holds, one component of all states beside the other.
static inline __attribute__((always_inline)) double lanes(void (*block)(const double *, double *), const double *start, int size) {
    for (int k = 0; k < size; k++)
        for (int i = 0; i < BLOCK; i++) states[k * BLOCK + i] = start[k];
    KEEP(states);
    const double begun = now();
    for (int pass = 0; pass < STATES / BLOCK; pass++) {
        KEEP(states);
        block(states, rates);
        KEEP(rates);
    }
    return (now() - begun) / STATES;
}

// A problem with its numbers, which the compiler knows, by the equations of one tool.
#define STATED(problem, tool, equations, size, kappa, c1)                                                               \
    static inline __attribute__((always_inline)) void problem##_##tool(const double *restrict y, double *restrict f) {  \
        equations##_##tool(y, f, 1, kappa, c1);                                                                         \
    }                                                                                                                   \
    static void problem##_##tool##_block(const double *restrict y, double *restrict f) {                                \
        for (int i = 0; i < BLOCK; i++) equations##_##tool(y + i, f + i, BLOCK, kappa, c1);                             \
    }                                                                                                                   \
    static void problem##_##tool##_times(const double *start, double least[3]) {                                        \
        for (int repeat = 0; repeat < REPEATS; repeat++) {                                                              \
            least[0] = fmin(least[0], chain(problem##_##tool, start, size));                                            \
            least[1] = fmin(least[1], throughput(problem##_##tool, start, size));                                       \
            least[2] = fmin(least[2], lanes(problem##_##tool##_block, start, size));                                    \
        }                                                                                                               \
    }                                                                                                                   \
    static long problem##_##tool##_run(double *y, double t_end, double tolerance) {                                     \
        return dop853(problem##_##tool, y, t_end, tolerance, size);                                                     \
    }
#define PROBLEM(problem, equations, size, kappa, c1)        \
    STATED(problem, sympy, equations, size, kappa, c1)      \
    STATED(problem, casadi, equations, size, kappa, c1)

PROBLEM(P1, missile, 21, 0, 0)
PROBLEM(P2, vibrating, 18, 10, 0.5)
PROBLEM(P2r, mirrored, 18, 10, 0.5)
PROBLEM(P3, elastic, 18, 10, 0.5)
PROBLEM(P5_1e4, vibrating, 18, 1e4, 0.5)
PROBLEM(P5_1e6, vibrating, 18, 1e6, 0.5)
PROBLEM(P6, elastic, 18, 1e6, 0.5)
PROBLEM(P7, stiff_missile, 21, 1e4, 0.5)
PROBLEM(P8, vibrating, 18, 10, 1e4)

#define BY(problem, tool, size) {#tool, #problem, size, problem##_##tool##_run, problem##_##tool##_times},
#define ROW(problem, size) BY(problem, sympy, size) BY(problem, casadi, size)
typedef struct {
    const char *tool, *problem;
    int size;
    long (*run)(double *, double, double);
    void (*times)(const double *, double *);
} Row;
// P5 large differs from P5 1e4 in its start.
static const Row ROWS[] = {
    ROW(P1, 21) ROW(P2, 18) ROW(P2r, 18) ROW(P3, 18) ROW(P5_1e4, 18) ROW(P5_1e6, 18) ROW(P6, 18) ROW(P7, 21) ROW(P8, 18)
};

static const Row *found(const char *tool, const char *problem) {
    for (size_t k = 0; k < sizeof ROWS / sizeof *ROWS; k++)
        if (!strcmp(ROWS[k].tool, tool) && !strcmp(ROWS[k].problem, problem)) return ROWS + k;
    return NULL;
}

static void run(const Row *row, const double *start, double tolerance, double t_end, double seconds) {
    double y[MOST], least = 1e300;
    const double begun = now();
    long evaluations;
    do {
        memcpy(y, start, sizeof y);
        const double before = now();
        evaluations = row->run(y, t_end, tolerance);
        KEEP(y);
        least = fmin(least, now() - before);
    } while (evaluations > 0 && now() - begun < seconds);
    if (evaluations < 0) {
        puts("failed");
        return;
    }
    printf("ok %.17g %ld", least, evaluations);
    for (int k = 0; k < row->size; k++) printf(" %.17g", y[k]);
    puts("");
}

int main(void) {
    char line[4096];
    while (fgets(line, sizeof line, stdin)) {
        char what[8], tool[16], problem[16];
        double numbers[MOST + 3] = {0};
        int read = 0;
        const int words = sscanf(line, "%7s %15s %15s%n", what, tool, problem, &read);
        const Row *row = words == 3 ? found(tool, problem) : NULL;
        int count = 0;
        for (char *next = line + read, *end; count < MOST + 3; next = end, count++) {
            numbers[count] = strtod(next, &end);
            if (end == next) break;
        }
        if (row && !strcmp(what, "run") && count == row->size + 3) {
            run(row, numbers + 3, numbers[0], numbers[1], numbers[2]);
        } else if (row && !strcmp(what, "rhs") && count == row->size) {
            double least[3] = {1e300, 1e300, 1e300};
            row->times(numbers, least);
            printf("ok %.4g %.4g %.4g\n", 1e9 * least[0], 1e9 * least[1], 1e9 * least[2]);
        } else {
            puts("failed");
        }
        fflush(stdout);
    }
}
