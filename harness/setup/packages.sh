# Sourced by ./run and ./check: installs the Debian packages that are missing, and says which; quiet builds.

# What the program needs to be built and to run.
build_packages="g++ cmake ninja-build pkg-config libembree-dev libopenimageio-dev libopenexr-dev libpng-dev libtbb-dev libpugixml-dev
  libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libfmt-dev libboost-dev libkainjow-mustache-dev
  zlib1g-dev povray bubblewrap libarchive-tools git mount"
# What the tests need on top.
check_packages="libgtest-dev libgmock-dev libvalijson-dev libboost-math-dev clang-format chromium libxml2-utils shellcheck python3-yaml
  universal-ctags zstd xz-utils bzip2"

# What ./run --with-cycles installs: a second unbiased engine to compare with. Nothing needs it.
cycles_packages="blender"

# What ./run --bench needs on top: the benchmark library, and a peer to be measured against.
bench_packages="libbenchmark-dev libnanoflann-dev"

# The fuzzers also need a compiler with libFuzzer, its sanitizers' libraries, and xz for the corpora.
fuzz_packages="clang libclang-rt-dev xz-utils"

# What sanitizers.sh needs on top: GCC 12 takes over six minutes for a kernel with checks of addresses, this half a minute
# (and clang 14 does not know the standard library's packs).
sanitizer_packages="clang-19 libclang-rt-19-dev llvm-19"

# install_packages NAME...: quick when nothing is missing; without root and sudo it lists what is missing and goes on,
# since the libraries may be there by other means.
install_packages() {
  if ! command -v apt-get >/dev/null; then
    echo "setup: no apt here; needed are the equivalents of: $*"
    return 0
  fi
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "setup: not installed, and no root to install them: ${missing[*]}"
      return 0
    fi
    as_root=(sudo)
  fi
  echo "setup: installing ${missing[*]}"
  local log
  log=$(mktemp)
  export DEBIAN_FRONTEND=noninteractive
  if ! { "${as_root[@]}" apt-get update && install_known "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
    tail -n 15 "$log" >&2
    echo "setup: apt could not install them, see $log" >&2
    return 1
  fi
  rm -f "$log"
}

# Packages the distribution does not have are left out (Ubuntu has no chromium package, for one); the configure step
# says what it then does without.
install_known() {
  local known=() package
  for package in "$@"; do
    if [ -n "$(apt-cache madison "$package")" ]; then known+=("$package"); else echo "no package $package here"; fi
  done
  "${as_root[@]}" apt-get install -y --no-install-recommends "${known[@]}"
}

# quietly LOG COMMAND...: one line of a command that succeeds, all of one that fails.
quietly() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  if ! "$@" >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
  tail -n 1 "$log"
}
