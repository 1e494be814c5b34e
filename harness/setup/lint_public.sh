#!/usr/bin/env bash
# Checks workflows, actions, issue forms and CITATION.cff against their published schemas.
#   harness/setup/lint_public.sh
# The first run installs check-jsonschema from Python's package index into an environment below build/.
set -euo pipefail
cd "$(dirname "$0")/../.."
environment=build/lint-environment
if ! python3 -c 'import ensurepip' 2>/dev/null; then
  source harness/setup/packages.sh
  install_packages python3-venv
fi
mkdir -p build
[ -x "$environment/bin/pip" ] || python3 -m venv "$environment"
"$environment/bin/pip" install --quiet --disable-pip-version-check 'check-jsonschema==0.36.*'
check() { # SCHEMA FILE...
  "$environment/bin/check-jsonschema" --builtin-schema "vendor.$1" "${@:2}"
}
check github-workflows .github/workflows/*.yml harness/ci/github-actions.yml
check github-actions harness/ci/gate/action.yml
check gitlab-ci harness/ci/gitlab-ci.yml
check github-issue-forms .github/ISSUE_TEMPLATE/{bug,scene,wrong-image}.yml
check github-issue-config .github/ISSUE_TEMPLATE/config.yml
check citation-file-format CITATION.cff
