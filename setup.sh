#!/usr/bin/env bash
# Brings .venv and the external codes up to date; what stands already is left alone.
#
#   setup.sh         .venv from requirements.lock, this package, YADE and LIGGGHTS through apt
#   setup.sh lock    requirements.lock anew from the lower bounds in pyproject.toml
#
# CODES=lmgc90,pybullet,kratos besides brings these, each into an environment .codes/NAME of its
# own, from adapters/NAME/requirements.txt; .codes/NAME/installed says what stands there.
# PYTHON names the interpreter to use, VV_APT=no forbids apt, and the codes that are named in
# VV_REQUIRE=yade,liggghts must be there in the end. .venv/made-for and .venv/installed say what
# stands; each is written last, so that a set-up that failed is taken up where it stopped.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1
REQUIRED=${VV_REQUIRE:-}
CODES=${CODES:-}
SCRATCH=$(mktemp -d)
trap 'wait; rm -rf -- "$SCRATCH"' EXIT

say() { printf 'setup: %s\n' "$*"; }

fail() {
    say "$*" >&2
    exit 1
}

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo -n "$@"; fi; }

may_apt() {
    [ "${VV_APT:-}" != no ] && command -v apt-get >/dev/null && as_root true 2>/dev/null
}

apt() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 "$@" \
        </dev/null >"$SCRATCH/apt.log" 2>&1
}

apt_install() {
    if [ ! -e "$SCRATCH/apt.log" ]; then
        apt update || true # one dead source must not keep the others from being used
    fi
    apt install --no-install-recommends "$@" && return
    say "apt-get install $* failed:" >&2
    tail -n 5 "$SCRATCH/apt.log" >&2
    return 1
}

recent() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; }

has_venv() { "$1" -c 'import ensurepip, venv' 2>/dev/null; }

# Print a recent Python: the first that can make environments, else the first.
pick_python() {
    local candidates=(python3 python3.14 python3.13 python3.12 python3.11 /usr/bin/python3)
    local candidate first=""
    if [ -n "${PYTHON:-}" ]; then candidates=("$PYTHON"); fi
    for candidate in "${candidates[@]}"; do
        recent "$candidate" || continue
        first=${first:-$candidate}
        if has_venv "$candidate"; then
            first=$candidate
            break
        fi
    done
    echo "$first"
}

make_venv() { # FOLDER
    local python package
    python=$(pick_python)
    [ -n "$python" ] || fail "${PYTHON:-python3} is not Python 3.11 or newer, which vv needs;" \
        "install one, or name it: make PYTHON=/path/to/python3.11 ..."
    if ! has_venv "$python"; then
        package=$("$python" -c 'import sys; print("python%d.%d-venv" % sys.version_info[:2])')
        may_apt || fail "$python cannot make environments; run: sudo apt-get install $package"
        say "installing $package with apt-get"
        apt_install "$package" || exit 1
    fi
    "$python" -m venv --clear "$1"
}

version() { "$1" -c 'import sys; print(*sys.version_info[:2], sys.prefix)' 2>/dev/null; }

# Whether .venv works, was made in this place by this Python, and is of the version wanted.
standing() {
    local now wanted
    now=$(version .venv/bin/python) && [ "$now" = "$(cat .venv/made-for 2>/dev/null)" ] || return
    if [ -z "${PYTHON:-}" ]; then return; fi
    wanted=$(version "$PYTHON") && [ "${now%% /*}" = "${wanted%% /*}" ]
}

environment() {
    if standing; then return; fi
    say "making .venv"
    make_venv .venv
    version .venv/bin/python >.venv/made-for
}

# Install what the lock names. A pip works on one core, so two take half of the packages each, both
# from the start: one that began later would meet what the other had not written to its end.
locked() { # PYTHON
    sed '/^#/d' requirements.lock | xargs -n 27 -P 0 \
        "$1" -m pip install --quiet --quiet --no-deps --no-compile
}

# Compile what was installed on all cores, where pip takes one; left out are tests of packages, and
# mypy, which is machine code.
compiled() { # PYTHON
    local folder
    folder=$("$1" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
    # templates may not compile
    "$1" -m compileall -q -j 0 -x '/(tests|mypyc?)/' "$folder" >/dev/null || true
}

packages() {
    local python=.venv/bin/python compiling
    cat requirements.lock pyproject.toml | cmp -s - .venv/installed && return
    say "installing the packages of requirements.lock into .venv"
    locked "$python"
    compiled "$python" &
    compiling=$!
    "$python" -m pip install --quiet --no-deps --no-build-isolation --editable .
    "$python" -m pip check >"$SCRATCH/check" || fail "requirements.lock: $(cat "$SCRATCH/check")"
    wait "$compiling"
    cat requirements.lock pyproject.toml >.venv/installed
}

required() { [[ ",${REQUIRED// /}," == *",$1,"* ]]; }

# Install a code unless it is there; .venv/no-CODE keeps apt from being asked for it in vain.
external() { # CODE, by the name of its program and package
    if command -v "$1" >/dev/null; then return; fi
    if may_apt && { required "$1" || [ ! -e ".venv/no-$1" ]; }; then
        say "installing $1 with apt-get (a minute or two)"
        apt_install "$1" || apt-cache show "$1" >/dev/null 2>&1 || touch ".venv/no-$1"
    fi
    if command -v "$1" >/dev/null; then return; fi
    if required "$1"; then fail "$1 is required (VV_REQUIRE) and missing: apt-get install $1"; fi
    say "$1 is missing and will be left out; to have it: sudo apt-get install $1"
}

# Bring a code that is a Python package into an environment of its own, by a Python that it is for.
own_environment() { # CODE
    local wanted="adapters/$1/requirements.txt" place=".codes/$1" python
    [ -f "$wanted" ] || fail "CODES has '$1'; there are: $(packaged)"
    if cmp -s "$wanted" "$place/installed" && version "$place/bin/python" >/dev/null; then return; fi
    say "installing $1 into $place"
    for python in ${PYTHON:-python3 python3.11 python3.12 python3.13 python3.14}; do
        if ! recent "$python" || ! has_venv "$python"; then continue; fi
        "$python" -m venv --clear "$place"
        if "$place/bin/python" -m pip install --quiet --no-deps --only-binary :all: \
            --requirement "$wanted" >"$SCRATCH/pip" 2>&1; then
            cat "$wanted" >"$place/installed"
            return
        fi
        say "no $1 for $python: $(grep -m 1 '^ERROR' "$SCRATCH/pip" || tail -n 1 "$SCRATCH/pip")"
    done
    rm -rf "$place"
    fail "$1 is not to be had: no Python here fits $(tr '\n' ' ' <"$wanted")"
}

# The codes that are Python packages, by name.
packaged() {
    local file names=()
    for file in adapters/*/requirements.txt; do
        file=${file%/requirements.txt}
        names+=("${file##*/}")
    done
    echo "${names[*]}"
}

lock() {
    make_venv "$SCRATCH/venv"
    "$SCRATCH/venv/bin/python" -m pip install --quiet ".[dev]"
    {
        echo "# What .venv is made of. Renew with: make lock PYTHON=python3.11 (the oldest supported)"
        "$SCRATCH/venv/bin/python" -m pip freeze --exclude vv
    } >"$SCRATCH/lock"
    cp "$SCRATCH/lock" requirements.lock
}

externals() {
    external yade
    external liggghts
}

setup() {
    local code aside
    environment
    externals & # while pip works: apt and pip together take as long as the longer one
    aside=$!
    packages
    wait "$aside"
    for code in ${CODES//,/ }; do own_environment "$code"; done
}

if command -v flock >/dev/null; then
    exec 9<.
    flock 9 # two set-ups at once in one folder wait for each other
fi
case "${1:-setup}" in
    setup) setup ;;
    lock) lock ;;
    *) fail "unknown command '$1'; there is: setup, lock" ;;
esac
