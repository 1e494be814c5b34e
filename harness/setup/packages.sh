# Sourced by ./run and ./check: installs missing Debian packages and names them; quiet builds.

# Packages to build and run the program.
build_packages="g++ cmake ninja-build pkg-config libembree-dev libopenimageio-dev libopenexr-dev libpng-dev libtbb-dev libpugixml-dev libassimp-dev
  libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libfmt-dev libboost-dev libkainjow-mustache-dev
  zlib1g-dev libsqlite3-dev libcairo2-dev povray bubblewrap libarchive-tools git mount"
# Additional packages for the tests. The packages texlive-* take 394 MB; they compile tables and plots for papers.
check_packages="libgtest-dev libgmock-dev libvalijson-dev libboost-math-dev clang-format chromium libxml2-utils shellcheck python3-yaml
  universal-ctags zstd xz-utils bzip2
  poppler-utils texlive-latex-recommended texlive-latex-extra texlive-publishers texlive-pictures
  texlive-fonts-recommended"

# Additional packages for harness/packaging/deb.sh: shared libraries' packages, and manual pages.
package_packages="dpkg-dev file help2man"

# Packages of ./run --with-cycles: a second unbiased engine for comparisons; optional.
cycles_packages="blender"

# Packages of ./run --with-mitsuba, which takes Mitsuba itself from Python's packages. Without libLLVM 17 or newer it runs
# its scalar code.
mitsuba_packages="python3-venv libllvm19"

# Additional packages of ./run --bench: the benchmark library, and a library to compare with.
bench_packages="libbenchmark-dev libnanoflann-dev"

# Additional packages for the fuzzers: a compiler with libFuzzer, its sanitizers' libraries, and xz for the corpora.
fuzz_packages="clang libclang-rt-dev xz-utils"

# Additional packages of sanitizers.sh. GCC 12 compiles a kernel with address checks in over six minutes, this clang in
# half a minute. (clang 14 cannot compile the standard library's packs.)
sanitizer_packages="clang-19 libclang-rt-19-dev llvm-19"

# install_packages NAME...: quick when nothing is missing. Without root and sudo it lists the missing packages and
# continues, since the libraries may be installed by other means.
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

# Leaves out packages that the distribution does not have (Ubuntu has no chromium package, for example). The configure
# step reports the missing features.
install_known() {
  local known=() package
  for package in "$@"; do
    if [ -n "$(apt-cache madison "$package")" ]; then known+=("$package"); else echo "no package $package here"; fi
  done
  "${as_root[@]}" apt-get install -y --no-install-recommends "${known[@]}"
}

# quietly LOG COMMAND...: prints one line if the command succeeds, and its whole output if it fails.
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

# best_kernels: the value of PHOTONPROOF_KERNELS for this processor, as glibc's loader names its level; "all" where it
# names none.
best_kernels() {
  local level
  level=$(/lib64/ld-linux-x86-64.so.2 --help 2>/dev/null | sed -n 's/^ *x86-64-\(v[234]\) (supported.*/\1/p' | head -n 1)
  echo "${level:-all}"
}
