#!/bin/sh
# Spheres and one wall by semi-implicit Euler, in awk: reads ask.json, writes series.csv.
test "$1" = --version && echo "awk_dem 1.0" && exit
exec awk '
function take(name, into,    at, text) {  # the numbers after "name":
    at = index(ask, "\"" name "\": ")
    if (!at) return 0
    text = substr(ask, at + length(name) + 4)
    match(text, /^[][0-9eE+., -]*/)
    text = substr(text, 1, RLENGTH)
    gsub(/[][,]/, " ", text)
    return split(text, into, " ")
}
function one(name,    found) { take(name, found); return found[1] + 0 }
function touch(i, j,    k, d, apart, size) {  # a spring between two spheres
    for (k = 1; k <= 3; k++) { d[k] = x[3*j+k] - x[3*i+k]; apart += d[k]^2 }
    apart = sqrt(apart); size = r[i+1] + r[j+1] - apart
    for (k = 1; k <= 3 && size > 0; k++) {
        f[3*i+k] -= kn * size * d[k] / apart; f[3*j+k] += kn * size * d[k] / apart
    }
}
function rub(    k, size, along, held) {  # a spring into the wall, one along it that slips
    size = r[1]
    for (k = 1; k <= 3; k++) { size -= (x[k] - p[k]) * n[k]; along += s[k] * n[k] }
    if (size < 0) size = 0
    for (k = 1; k <= 3; k++) { s[k] -= along * n[k]; held += s[k]^2 }
    held = ks * sqrt(held)
    for (k = 1; k <= 3; k++) {
        if (held > mu * kn * size) s[k] *= mu * kn * size / held
        f[k] += kn * size * n[k] - ks * s[k]
    }
}
{ ask = ask $0 "\n" }
END {
    count = take("body", body); wall = take("point", p)
    kn = one("kn"); ks = one("ks"); mu = one("mu"); eta = one("drag")
    if (ask ~ /}, \{"body"/ || count > 1 && (wall || mu)) {
        print "it has one sphere on one wall, or several without friction" > "/dev/stderr"
        exit 3
    }
    take("position", x); take("velocity", v); take("load", load); take("free", may)
    take("radius", r); take("mass", m); take("normal", n)
    dt = one("dt"); steps = one("steps"); stride = one("stride")
    printf "t"
    for (k = 1; k <= 3 * count; k++) {
        start[k] = x[k]
        printf ",displacement_%d_%s", body[int((k + 2) / 3)], substr("xyz", (k - 1) % 3 + 1, 1)
    }
    for (step = 0; step <= steps; step++) {
        if (step % stride == 0) printf "\n%.17g", step * dt
        for (k = 1; k <= 3 * count; k++) {
            if (step % stride == 0) printf ",%.17g", x[k] - start[k]
            f[k] = load[k] - eta * v[k]
        }
        if (wall) rub()
        for (i = 0; i < count; i++) for (j = i + 1; j < count; j++) touch(i, j)
        for (k = 1; k <= 3 * count; k++) {
            v[k] += may[k] * dt * f[k] / m[int((k + 2) / 3)]
            x[k] += dt * v[k]; s[k] += dt * v[k]
        }
    }
}' ask.json > series.csv
