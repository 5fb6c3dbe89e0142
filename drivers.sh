#!/bin/sh
# Installs the drivers that no Python package brings, where they are missing and it may: Mesa's software OpenGL, and
# the system's PoCL where the wheel's compiler does not know this processor. Otherwise says in one line what is missing.
# The packages have these names in Debian 12, Debian 13 and Ubuntu 24.04.
# With "chromium" as a second word, a browser instead, which drives the report's HTML page in the tests.
python=$1

may_install() { # run "$@" as root, if that is possible without asking
    command -v apt-get >/dev/null || return 1
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}

install() { # install PACKAGE...
    may_install apt-get -qq update >/dev/null 2>&1 &&
        may_install env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends "$@" >/dev/null 2>&1
}

browser() { # the names that tests/browser.py looks for
    command -v chromium || command -v chromium-browser || command -v google-chrome
}

if [ "$2" = chromium ]; then
    browser >/dev/null && exit 0
    echo "no chromium; installing it"
    install chromium
    browser >/dev/null || echo "chromium is missing: install it; tests that drive a browser are skipped."
    exit 0
fi

has() { # has NAME: is there a usable device of that name?
    "$python" -m harness.cli list devices 2>/dev/null | grep "^$1" | grep -q 'usable$'
}

want() { # want NAME MESSAGE PACKAGE...: a usable device of that name, from the system's packages if need be
    name=$1 message=$2
    shift 2
    has "$name" && return
    echo "no usable ${name%:}; installing $*"
    install "$@"
    has "$name" || echo "$message"
}

want opengl: "OpenGL is missing: install libegl1, libgl1 and libgl1-mesa-dri (or a GPU driver); going on with OpenCL." \
    libegl1 libgl1 libgl1-mesa-dri
want opencl:pocl "PoCL is missing: install pocl-opencl-icd; going on with the other devices." pocl-opencl-icd
exit 0
