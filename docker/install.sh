#!/bin/sh
# Installs Kuglice from this source tree into a virtual environment of its own: docker/install.sh PREFIX
# The Dockerfile runs it, and so does tests/packaging, in an empty directory. Needs Python 3.11+, cargo and cc.
set -eu
prefix=${1:?"usage: docker/install.sh PREFIX"}
source=$(cd "$(dirname "$0")/.." && pwd)

python3 -m venv "$prefix"
# A failure is only a note here: the image is as good with newer versions, and says which ones it has.
"$prefix/bin/python" "$source/.ci/pin_cargo.py" || true
"$prefix/bin/pip" install --quiet --disable-pip-version-check --no-cache-dir \
    --constraint "$source/.ci/python-constraints.txt" "$source[render]"
"$prefix/bin/kuglice" scenes >/dev/null
