# shellcheck shell=bash
# Sourced by scripts that install Python packages into a virtual environment of their own.

# install_wheels NAME FOLDER REQUIREMENTS NEEDS: the packages with their hashes, a line each. NEEDS is what a failure
# names as missing.
install_wheels() {
  local name=$1 folder=$2 requirements=$3 needs=$4
  mkdir -p "$folder"
  {
    python3 -m venv "$folder"
    echo "$requirements" >"$folder/requirements.txt"
    "$folder/bin/python" -m pip install --no-deps --only-binary :all: --require-hashes -r "$folder/requirements.txt"
  } >"$folder/install.log" 2>&1 || {
    tail -n 15 "$folder/install.log" >&2
    echo "$name could not be installed, see $folder/install.log ($needs)" >&2
    return 1
  }
}
