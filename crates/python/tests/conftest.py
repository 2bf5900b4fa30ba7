"""What the tests share: the repository and its examples."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples"
RECORD = ROOT / "ground_motions" / "el_centro_1940_ns.csv"
PAIR = EXAMPLES / "three_storey_pair" / "case.toml"


@pytest.fixture()
def pair_dict() -> dict:
    """The first example as a dict, without its ground motion's path."""
    tables = {
        "building": [
            {
                "name": "light",
                "storeys": 3,
                "mass": "25 t",
                "stiffness": 3.46e6,
                "height": "3 m",
                "damping": {"stiffness_proportional": 0.05},
            },
            {
                "name": "heavy",
                "storeys": 3,
                "mass": 1.0e6,
                "stiffness": "2215 MN/m",
                "height": 3.0,
                "damping": {"stiffness_proportional": 0.05},
            },
        ],
        "gap": [
            {
                "between": ["light", "heavy"],
                "width": "20 mm",
                "model": "jankowski_2005",
                "stiffness": "2.75e9 N/m^1.5",
                "restitution": 0.65,
            }
        ],
        "ground_motion": {"file": str(RECORD)},
        "analysis": {"duration": "8 s"},
    }
    return tables
