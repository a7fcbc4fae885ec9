# Sourced by quickstart and test: installs what is missing and builds. Needs `root` (the project's folder).

say() { printf '\n==> %s\n' "$*"; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        echo "Packages are missing and this is neither root nor is there sudo. Install them as root: $*" >&2
        exit 1
    fi
}

# install_packages LIST...: the Debian packages named in the files that are not there yet.
install_packages() {
    # shellcheck disable=SC2046
    need_packages $(sed 's/#.*//' "$@")
}

is_installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; }

need_packages() {
    local missing=() package
    for package in "$@"; do
        # Node.js may have come from elsewhere than Debian, with an npm of its own that Debian's would displace.
        case $package in
            nodejs) command -v node >/dev/null && continue ;;
            npm) command -v npm >/dev/null && continue ;;
            # Debian's ParaView has VTK's Python modules of its own, and the two packages exclude each other.
            python3-vtk9) is_installed paraview && package=python3-paraview ;;
        esac
        is_installed "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    say "installing ${#missing[@]} Debian packages: ${missing[*]}"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# build programs|tests [PRESET [OPTION...]]: configures and builds; the preset is release unless given. Programs alone
# need no test libraries; a folder that has been configured with tests keeps them.
build() {
    local options=() preset=${2:-release}
    [ "$1" = tests ] && options=(-DBREACH_TESTS=ON)
    [ "$1" = programs ] && [ ! -f "$root/build/$preset/CMakeCache.txt" ] && options=(-DBREACH_TESTS=OFF)
    options+=("${@:3}")
    say "building ($1, $preset)"
    (cd "$root" && cmake --preset "$preset" "${options[@]}" && cmake --build --preset "$preset")
}
