# Sourced by ./run and ./test: packages of Debian 12 and the build. Plain sh: a bare machine has nothing else.

packages_for() {
    case $1 in
    build)
        echo "ca-certificates ccache cmake fonts-dejavu-core g++ git libassimp-dev libcli11-dev libglfw3-dev libglm-dev
              libgmp-dev libhwy-dev libimgui-dev libosmesa6-dev libpng-dev libtbb-dev libtinygltf-dev libtinyobjloader-dev
              ninja-build nlohmann-json3-dev pkg-config python3-glad libgl1-mesa-dri"
        ;;
    test)
        echo "clang-format-14 libgtest-dev libxtst-dev xvfb"
        ;;
    esac
}

# install_packages GROUP...: installs what is not there yet; asks for root only then.
install_packages() {
    missing=""
    for group in "$@"; do
        for package in $(packages_for "$group"); do
            status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
            [ "$status" = "install ok installed" ] || missing="$missing $package"
        done
    done
    [ -n "$missing" ] || return 0
    echo "Installing:$missing"
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || {
            echo "These packages are missing, and installing them needs root. As root: apt-get install$missing" >&2
            exit 1
        }
        as_root="sudo"
    fi
    $as_root apt-get update -qq
    # shellcheck disable=SC2086
    DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# build_preset PRESET TARGET: says what it does, shows the compiler's words only if it fails.
build_preset() {
    echo "== building $1"
    mkdir -p "build/$1"
    cmake --preset "$1" >"build/$1/configure.log" 2>&1 || {
        cat "build/$1/configure.log"
        exit 1
    }
    cmake --build "build/$1" --target "$2" >"build/$1/build.log" 2>&1 || {
        grep -E 'error|warning|FAILED' -A 8 "build/$1/build.log" | head -n 80
        echo "log: build/$1/build.log"
        exit 1
    }
}
