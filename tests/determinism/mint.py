"""`make golden`: takes new golden hashes; none is replaced while STEP_VERSION stays, unless told --force."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from determinism import golden


def main() -> int:
    """Exit code 1 when refused."""
    fresh = {golden.label(name, model): golden.hashes(name, model) for name, model in golden.runs()}
    try:
        minted = golden.mint(fresh, force="--force" in sys.argv[1:])
    except golden.RefusedError as refused:
        print(f"mint: {refused}", file=sys.stderr)
        return 1
    print(
        f"mint: {len(minted)} of {len(fresh)} golden hashes are new, in {golden.FILE.name}", file=sys.stderr
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
