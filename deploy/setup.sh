# Sourced by quickstart and test: installs what is missing and builds. Needs `root` (the project's folder).

say() { printf '\n==> %s\n' "$*"; }
fail() { printf '%s\n' "$*" >&2 && exit 1; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        fail "Packages are missing, and you are neither root nor have sudo. As root run: apt-get install ${missing[*]}"
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
        # Node.js from another source has its own npm, which Debian's npm would replace.
        case $package in
            nodejs) command -v node >/dev/null && continue ;;
            npm) command -v npm >/dev/null && continue ;;
            # Debian's ParaView includes VTK's Python modules, and the two packages conflict.
            python3-vtk9) is_installed paraview && package=python3-paraview ;;
        esac
        is_installed "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    command -v apt-get >/dev/null || fail "There is no apt-get: Breachline builds on Debian 12. Missing: ${missing[*]}"
    say "installing ${#missing[@]} Debian packages: ${missing[*]}"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq -o Acquire::Retries=2 -o APT::Update::Error-Mode=any ||
        fail "Debian's package archive cannot be read (see above). Check the network, a proxy in /etc/apt/apt.conf.d, and /etc/apt/sources.list; or install: ${missing[*]}"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
        fail "apt-get could not install the packages (see above). Free disk on /usr: $(df -h --output=avail /usr | tail -n 1)"
}

# Largest memory of one compiler process, and disk space of a build [MB].
compiler_MB=1100
declare -A build_MB=([first_result]=700 [programs]=800 [manuals]=800 [all]=2500)

# Checks compiler, memory and disk before a build. Sets `jobs` from cores and memory.
check_machine() {
    local compiler=${CXX:-g++} version free_MB disk_MB need_MB=${build_MB[$1]:-2500}
    version=$("$compiler" -dumpfullversion 2>/dev/null) || version=$("$compiler" -dumpversion 2>/dev/null) ||
        fail "There is no C++ compiler \"$compiler\". Install g++ or set CXX to one."
    if [ "${version%%.*}" -lt 12 ] && ! "$compiler" --version | grep -qi clang; then
        fail "$compiler is version $version; C++20 as used here needs GCC 12 (Debian 12) or later. Set CXX to such a compiler."
    fi
    free_MB=$(awk '/^(MemAvailable|SwapFree):/ { sum += $2 } END { print int(sum / 1024) }' "${meminfo:-/proc/meminfo}")
    jobs=$((free_MB / compiler_MB))
    [ $jobs -ge 1 ] ||
        fail "A compiler needs up to $compiler_MB MB and only $free_MB MB of memory and swap are free. Close programs or add swap (fallocate -l 2G /swap && mkswap /swap && swapon /swap)."
    [ $jobs -le "$(nproc)" ] || jobs=$(nproc)
    mkdir -p "$root/build" 2>/dev/null || fail "$root/build cannot be made: the disk is full or the folder is not yours."
    disk_MB=$(($(df -k --output=avail "$root/build" | tail -n 1) / 1024))
    [ -e "$root/build/$2/build.ninja" ] || [ "$disk_MB" -ge "$need_MB" ] ||
        fail "The build needs $need_MB MB on the disk of $root/build and $disk_MB MB are free. Free some, or put the project on another disk."
}

# Seconds per compiled file of a target (tests/benchmark/build_time prints this line), of any other target, and of a step that compiles nothing.
declare -A step_seconds=([breachline]=20 [fem]=17 [fem_loops]=48 [geometry_loops]=13 [import]=13 [lem]=16 [lem_loops]=16 [mpm]=12 [orchestrator]=19 [process]=21 [scene]=16 [templates]=19 [transfer]=17 [transfer_loops]=35)
other_seconds=4 link_seconds=0

# weigh STEP: sets `weight`, what one of Ninja's lines weighs in the time left.
weigh() {
    weight=$link_seconds
    [[ ! $1 =~ /CMakeFiles/([^/]+)\.dir/ ]] || weight=${step_seconds[${BASH_REMATCH[1]}]:-$other_seconds}
}

# show_progress STEPS: Ninja's lines "[done/total seconds] step" as a bar with the time left, by the weights of the STEPS that Ninja plans;
# passes other lines (warnings, errors) on.
show_progress() {
    local line text weight all=0 done=0 seconds left percent told=0 open=no
    local full="#########################"
    while IFS= read -r line; do
        weigh "$line" && all=$((all + weight))
    done <<<"$1"
    while IFS= read -r line; do
        if [[ $line =~ ^\[([0-9]+)/([0-9]+)\ ([0-9]+)\.?[0-9]*\]\  ]]; then
            printf -v text 'step %d of %d' "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
            seconds=${BASH_REMATCH[3]}
            weigh "$line" && done=$((done + weight))
            percent=$((all > 0 ? 100 * done / all : 100)) left=$((done > 0 ? seconds * (all - done) / done : 0))
            printf -v text '%3d %%  %s, about %d:%02d min left' $percent "$text" $((left / 60)) $((left % 60))
            if [ -t 1 ]; then
                printf '\r[%-25s] %s\033[K' "${full:0:$((percent / 4))}" "$text" && open=yes
            elif [ $percent -ge $((told + 10)) ]; then
                printf '%s\n' "$text" && told=$percent
            fi
        else
            [ $open = no ] || printf '\n'
            open=no && printf '%s\n' "$line"
        fi
    done
    [ $open = no ] || printf '\n'
}

# build first_result|programs|manuals|all [PRESET [OPTION...]]: configures and builds; default preset: release. Targets other than `all` need
# no test libraries; a folder configured with tests keeps them.
build() {
    local options=() target=(--target "$1") preset=${2:-release} jobs
    [ "$1" = all ] && options=(-DBREACH_TESTS=ON -DBREACH_THIS_CPU=OFF) target=()  # `all`: the preset's targets
    [ "$1" != all ] && [ ! -f "$root/build/$preset/CMakeCache.txt" ] && options=(-DBREACH_TESTS=OFF)
    [ "$1" = first_result ] && [ ! -f "$root/build/$preset/CMakeCache.txt" ] && options+=(-DBREACH_THIS_CPU=ON)
    command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    export CCACHE_BASEDIR=$root  # shares the cache between folders
    options+=("${@:3}")
    check_machine "$1" "$preset"
    say "building ($1, $preset, $jobs at a time)"
    (cd "$root" && cmake --preset "$preset" "${options[@]}" >"build/configure.log" 2>&1) || {
        cat "$root/build/configure.log" >&2
        fail "CMake could not configure the build (see above)."
    }
    (
        cd "$root"
        steps=$(cmake --build --preset "$preset" "${target[@]}" -- -n) || true  # the build itself reports what is wrong
        NINJA_STATUS='[%f/%t %e] ' cmake --build --preset "$preset" "${target[@]}" -j "$jobs" 2>&1 | show_progress "$steps"
    )
}
