#!/bin/sh
# Runs one browser test: run.sh TEST BUILD_FOLDER. Installs playwright-core into the build folder when it is not there.
# Exit code 77: skipped, because the machine has no Chromium or Node.js.
set -eu
test_file=$1
build=$2
here=$(cd "$(dirname "$0")" && pwd)

for program in /usr/bin/chromium node npm; do
    if ! command -v "$program" > /dev/null; then
        echo "skipped: $program is not installed (apt-get install chromium nodejs npm)"
        exit 77
    fi
done

mkdir -p "$build"
(
    flock 9 # the first of several tests installs
    if ! cmp -s "$here/package-lock.json" "$build/package-lock.json" || [ ! -d "$build/node_modules/playwright-core" ]; then
        cp "$here/package.json" "$here/package-lock.json" "$build/"
        cd "$build" && npm ci --ignore-scripts --no-audit --no-fund
    fi
) 9> "$build/lock"
BREACH_BROWSER_BUILD=$build exec node "$here/$test_file"
