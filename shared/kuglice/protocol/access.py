"""Who may say what on a server's links: what only the server says is taken from nobody, what is said to it is passed on
to nobody.
"""

from __future__ import annotations

from typing import Any

from kuglice.protocol.keys import Keys

__all__ = ["access_control"]


def access_control(keys: Keys) -> dict[str, Any]:
    """Zenoh's configuration of that name, for the session of the server of one world.

    It holds for those who are linked to the server. A router in between passes on what its own clients say to each
    other. A rule does not cover a key with wildcards, which whoever receives it must look for.
    """
    told = [keys.tick, keys.snapshot, keys.holding, keys.all_regions]
    asked = [keys.about, keys.view, keys.history, keys.status]
    denied = [
        _denied("told by the server alone", "ingress", ["put", "delete"], told),
        _denied("answered by the server alone", "ingress", ["declare_queryable"], asked),
        _denied("asked of the server alone", "egress", ["query"], asked),
        _denied("heard by the server alone", "ingress", ["declare_subscriber"], [keys.inputs]),
        _denied("said to the server alone", "egress", ["put", "delete"], [keys.inputs]),
        _denied(
            "seen by the server alone",
            "ingress",
            ["declare_liveliness_subscriber", "liveliness_query"],
            [keys.clients],
        ),
        _denied("shown to the server alone", "egress", ["liveliness_token"], [keys.clients]),
    ]
    return {
        "enabled": True,
        "default_permission": "allow",
        "rules": denied,
        "subjects": [{"id": "anybody"}],
        "policies": [{"rules": [rule["id"] for rule in denied], "subjects": ["anybody"]}],
    }


def _denied(rule: str, flow: str, messages: list[str], key_exprs: list[str]) -> dict[str, Any]:
    return {
        "id": rule,
        "permission": "deny",
        "flows": [flow],
        "messages": messages,
        "key_exprs": key_exprs,
    }
