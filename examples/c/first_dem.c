/* Spheres and one wall by semi-implicit Euler: reads ask.json, writes series.csv. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
enum { MOST = 3 * 64, TEXT = 1 << 20 };
static char ask[TEXT];
static double x[MOST], x0[MOST], v[MOST], f[MOST], s[MOST], load[MOST], may[MOST], r[MOST], m[MOST];
static double body[MOST + 1], p[3], n[3], kn, ks, mu, eta, dt, last, each;
static int take(const char *name, double *into, int most) { /* the numbers after "name": */
    char key[64], *end, *at;
    int count = 0;
    snprintf(key, sizeof key, "\"%s\": ", name);
    if (!(at = strstr(ask, key))) return 0;
    for (at += strlen(key); count < most; at = end, count++) {
        at += strspn(at, " ,[]");
        into[count] = strtod(at, &end);
        if (end == at) break;
    }
    return count;
}
static double dot(const double *a, const double *b) { return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]; }
static void push(double *force, double size, const double *along) {
    for (int k = 0; k < 3; k++) force[k] += size * along[k];
}
static void touch(int i, int j) { /* a spring between two spheres */
    double d[3] = {x[3*j] - x[3*i], x[3*j+1] - x[3*i+1], x[3*j+2] - x[3*i+2]};
    double apart = sqrt(dot(d, d)), size = kn * fmax(0, r[i] + r[j] - apart) / apart;
    push(f + 3*i, -size, d), push(f + 3*j, size, d);
}
static void rub(int i) { /* a spring along the wall's normal, one along the wall that slips */
    double size = kn * fmax(0, r[i] - dot(x + 3*i, n) + dot(p, n)), held;
    push(s + 3*i, -dot(s + 3*i, n), n), held = ks * sqrt(dot(s + 3*i, s + 3*i));
    if (held > mu * size) push(s + 3*i, mu * size / held - 1, s + 3*i);
    push(f + 3*i, size, n), push(f + 3*i, -ks, s + 3*i);
}
int main(int argc, char **argv) {
    if (argc > 1 && !strcmp(argv[1], "--version")) return puts("first_dem 1.0"), 0;
    FILE *in = fopen("ask.json", "r"), *out = fopen("series.csv", "w");
    if (!in || !out || !fread(ask, 1, TEXT - 1, in)) return perror("ask.json, series.csv"), 1;
    int count = take("body", body, MOST + 1), wall = take("point", p, 3);
    take("kn", &kn, 1), take("ks", &ks, 1), take("mu", &mu, 1), take("drag", &eta, 1);
    if (strstr(ask, "}, {\"body\"") || count > MOST / 3 || (count > 1 && (wall || mu > 0)))
        return fputs("it has one sphere on one wall, or 64 without friction\n", stderr), 3;
    take("position", x, MOST), take("velocity", v, MOST), take("load", load, MOST);
    take("free", may, MOST), take("radius", r, MOST), take("mass", m, MOST), take("normal", n, 3);
    take("dt", &dt, 1), take("steps", &last, 1), take("stride", &each, 1);
    memcpy(x0, x, sizeof x), fputs("t", out);
    for (int k = 0; k < 3 * count; k++) fprintf(out, ",displacement_%g_%c", body[k/3], "xyz"[k%3]);
    for (int step = 0; step <= last; step++) {
        int shown = step % (int)each == 0 && fprintf(out, "\n%.17g", step * dt);
        for (int k = 0; k < 3 * count && shown; k++) fprintf(out, ",%.17g", x[k] - x0[k]);
        for (int k = 0; k < 3 * count; k++) f[k] = load[k] - eta * v[k];
        for (int i = 0; i < count && wall; i++) rub(i);
        for (int i = 0; i < count; i++) for (int j = i + 1; j < count; j++) touch(i, j);
        for (int k = 0; k < 3 * count; k++)
            v[k] += may[k] * dt * f[k] / m[k/3], x[k] += dt * v[k], s[k] += dt * v[k];
    }
    return fclose(out);
}
