#!/bin/sh
# A course exported by GNU parallel on this machine; killed on the way and run again.
#
#     tests/farm/parallel.sh COURSE OUT [FORMATS]
#
# Needs `parallel` (Debian: parallel) and `lianpu` on the PATH (or LIANPU). COURSE is a folder of lessons.
set -eu
course=$(realpath "${1:?usage: parallel.sh COURSE OUT [FORMATS]}") out=$(realpath -m "${2:?}") formats=${3:-png,srt}
program=$(command -v "${LIANPU:-lianpu}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" farm parallel "$course" --to "$formats" --out "$out" --tasks "${TASKS:-4}" --program "$program" \
    >"$folder/job.sh"
# Stopped by a signal that nobody can answer, with all it has started: a session of its own.
setsid sh "$folder/job.sh" &
session=$!
sleep "${KILL_AFTER:-5}"
pkill -KILL -s "$session" || { echo "it was done before it was killed: set KILL_AFTER to fewer seconds" >&2; exit 1; }
wait "$session" || :
echo "killed with $(find "$out" -name '*.png' | wc -l) frames on disk"
"$program" merge "$out" && echo "nothing was missing" || echo "the rest is made now"
sh "$folder/job.sh"
"$program" export "$course" --to "$formats" --out "$folder/plain" >/dev/null
cmp "$folder/plain/manifest.json" "$out/manifest.json" && echo "a plain export has the same manifest"
[ -z "$(find "$out" -name '.*' -type f)" ] || { echo "something is left over" >&2; exit 1; }
