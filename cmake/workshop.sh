# shellcheck shell=bash
# What ./run and ./test share: install what is missing, configure, build. Sourced, not run.
# Quick when there is nothing to do.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
if [ -z "${HOME:-}" ]; then # ccache wants one, a bare chroot may lack it
    HOME=$(getent passwd "$(id -u)" | cut -d: -f6)
    export HOME="${HOME:-/tmp}"
fi

say() { printf 'isolux: %s\n' "$*" >&2; }

fail() {
    say "$*"
    exit 1
}

# Runs a command with its output kept in a log; shows the log's end only if it fails.
quietly() {
    local log=$1
    shift
    mkdir -p "$(dirname "$log")"
    if ! "$@" >"$log" 2>&1 </dev/null; then
        tail -n 40 "$log" >&2
        return 1
    fi
}

# Packages of the list for the given uses, one a line.
wanted_packages() {
    awk -v stages=" $* " '!/^#/ && NF == 2 && index(stages, " " $1 " ") { print $2 }' \
        "$root/cmake/debian-packages.txt"
}

# Those of them that are not installed.
missing_packages() {
    local -a wanted
    mapfile -t wanted < <(wanted_packages "$@")
    # shellcheck disable=SC2016 # ${...} is dpkg-query's own
    dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null |
        awk -v wanted="${wanted[*]}" '
            $2 == "installed" { have[$1] = 1 }
            END { n = split(wanted, w, " "); for (i = 1; i <= n; ++i) if (!have[w[i]]) print w[i] }'
}

install_packages() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        return # another system: CMake will name what it does not find
    fi
    local -a missing as_root=()
    mapfile -t missing < <(missing_packages "$@")
    if [ ${#missing[@]} -eq 0 ]; then
        return
    fi
    local by_hand="apt-get install --no-install-recommends ${missing[*]}"
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null ||
            fail "${#missing[@]} Debian packages are missing (neither root nor sudo here to install them). As root: $by_hand"
        as_root=(sudo env DEBIAN_FRONTEND=noninteractive)
        sudo -n true 2>/dev/null || { [ -t 0 ] && sudo -v; } ||
            fail "${#missing[@]} Debian packages are missing (sudo was refused). As root: $by_hand"
    fi
    say "installing ${#missing[@]} missing Debian packages (once): ${missing[*]}"
    quietly "$root/build/apt-update.log" "${as_root[@]}" apt-get update ||
        say "apt-get update failed; trying with the package lists there are"
    quietly "$root/build/apt-install.log" "${as_root[@]}" apt-get install -y -q \
        --no-install-recommends "${missing[@]}" ||
        fail "the packages could not be installed (apt's words are above). By hand: $by_hand"
}

# configure PRESET: only when there is no build folder yet, the presets changed since, or the
# checkout has moved. Ninja itself notices changes of the CMake files.
configure() {
    local folder="$root/build/$1" fresh=()
    if [ -f "$folder/CMakeCache.txt" ] &&
        ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
        fresh=(--fresh)
    elif [ -f "$folder/build.ninja" ] && [ ! "$root/CMakePresets.json" -nt "$folder/build.ninja" ]; then
        return
    fi
    say "configuring build/$1"
    quietly "$root/build/configure-$1.log" cmake -S "$root" --preset "$1" "${fresh[@]}" ||
        fail "CMake could not configure (its words are above; all of them in build/configure-$1.log)"
}

# build PRESET [TARGET...]: Ninja's progress line on a terminal, otherwise only what goes wrong.
build() {
    local preset=$1 quiet=(--quiet)
    shift
    if [ -t 1 ]; then
        quiet=()
    fi
    if [ ! -f "$root/build/$preset/.ninja_log" ]; then
        say "building (some minutes, this first time)"
    fi
    # ccache takes precompiled headers only if told that time stamps do not matter
    CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros \
        NINJA_STATUS='[%f/%t] ' ninja -C "$root/build/$preset" -j "$(nproc)" "${quiet[@]}" "$@" >&2 ||
        fail "the build failed (the compiler's words are above)"
}
