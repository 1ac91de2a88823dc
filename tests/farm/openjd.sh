#!/bin/sh
# A course exported by OpenJD's own program on this machine.
#
#     tests/farm/openjd.sh COURSE OUT [FORMATS]
#
# Needs `openjd` (PyPI: openjd-cli) and `lianpu` on the PATH (or LIANPU). COURSE is a folder of lessons.
set -eu
course=$(realpath "${1:?usage: openjd.sh COURSE OUT [FORMATS]}") out=$(realpath -m "${2:?}") formats=${3:-png,srt}
program=$(command -v "${LIANPU:-lianpu}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" farm openjd "$course" --to "$formats" --out "$out" --tasks "${TASKS:-4}" --program "$program" \
    >"$folder/job.yaml"
openjd check "$folder/job.yaml"
openjd run "$folder/job.yaml"
"$program" merge "$out"
"$program" export "$course" --to "$formats" --out "$folder/plain" >/dev/null
cmp "$folder/plain/manifest.json" "$out/manifest.json" && echo "a plain export has the same manifest"
