#!/usr/bin/env bash
# Builds the documentation's site. A warning, such as a link that leads nowhere, fails it.
#   docs/build_site.sh          into build/site
#   docs/build_site.sh serve    serves it at http://127.0.0.1:8000, and builds it again after each change
# The first run installs MkDocs from Python's package index into an environment below build/.
set -euo pipefail
cd "$(dirname "$0")/.."
environment=build/site-environment
if ! python3 -c 'import ensurepip' 2>/dev/null; then
  source harness/setup/packages.sh
  install_packages python3-venv
fi
mkdir -p build
[ -x "$environment/bin/pip" ] || python3 -m venv "$environment"
"$environment/bin/pip" install --quiet --disable-pip-version-check --requirement docs/requirements.txt

export NO_MKDOCS_2_WARNING=1  # the theme's banner about later versions, which requirements.txt does not take
# Paths are relative to this file, which inherits everything else.
cat >build/mkdocs.yml <<'YAML'
INHERIT: ../docs/mkdocs.yml
docs_dir: ../docs
site_dir: site
hooks: [../docs/site_hooks.py]
YAML
case "${1:-build}" in
  build) exec "$environment/bin/mkdocs" build --strict --config-file build/mkdocs.yml ;;
  serve) exec "$environment/bin/mkdocs" serve --config-file build/mkdocs.yml ;;
  *) echo "usage: $0 [serve]" >&2 && exit 2 ;;
esac
