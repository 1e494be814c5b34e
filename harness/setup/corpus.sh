#!/usr/bin/env bash
# Adds inputs to the stored corpus of a fuzz target. An input of the same name is replaced.
#   harness/setup/corpus.sh ARCHIVE FILE...     e.g. scenes/ply_corpus.tar.xz build/fuzz/found/ply_fuzz/crash-*
# The archive holds one folder of its own name. Equal inputs always give equal bytes.
set -euo pipefail
if [ $# -lt 2 ] || [[ $1 != *.tar.xz ]]; then
  echo "usage: $0 ARCHIVE.tar.xz FILE..." >&2
  exit 2
fi
archive=$1 corpus=$(basename "$1" .tar.xz)
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/$corpus"
[ ! -e "$archive" ] || tar -C "$work" -xJf "$archive"
cp -- "$@" "$work/$corpus/"
tar -C "$work" --format=gnu --sort=name --owner=0 --group=0 --numeric-owner --mtime=@0 --mode=a-x,u=rwX,go=rX \
  -cf "$work/packed.tar" "$corpus"
# Versions of xz may compress the same archive differently, so an unchanged archive is not written again.
if [ ! -e "$archive" ] || ! xz -dc "$archive" | cmp -s - "$work/packed.tar"; then
  xz -9e -T1 -c "$work/packed.tar" >"$archive.part"
  mv "$archive.part" "$archive"
fi
