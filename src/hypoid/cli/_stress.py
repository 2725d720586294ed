"""`hypoid stress`."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees
from typing import TYPE_CHECKING, Any

import numpy as np

from ._load_options import NM, Figure, LoadOptions, computed_for, ended, write_figure
from ._options import AsJson, DesignPath
from ._output import write_json, write_table

if TYPE_CHECKING:
    from hypoid.load import RootStress

SIDES = ("concave", "convex")
USUAL = LoadOptions()


def stress(
    file: DesignPath,
    /,
    *,
    options: LoadOptions = USUAL,
    figure: Figure = None,
    json: AsJson = False,
) -> int:
    """Stress in both root fillets of both members over the mesh cycle, per torque.

    Options are those of `hypoid load`; what that has computed is not computed again.
    """
    found = computed_for(file, options, figure)
    if figure is not None:
        from hypoid.report import root_stress_figure

        last = found.loaded.cases[-1].torque, found.stress[-1]
        write_figure(lambda: root_stress_figure(*last), figure)
    if json:
        cases = [
            {
                "torque_Nm": case.torque * NM,
                "max_root_stress_MPa": {n: s.max_principal for n, s in stresses.items()},
                **{name: _member(s) for name, s in stresses.items()},
            }
            for case, stresses in zip(found.loaded.cases, found.stress, strict=True)
        ]
        assumed = [asdict(a) for a in found.assumed]
        write_json(
            {
                "direction": options.direction,
                "complete": found.loaded.complete,
                "cases": cases,
                "assumed": assumed,
            }
        )
    else:
        for name in ("pinion", "wheel"):
            columns = [f"{case.torque * NM:g} N m" for case in found.loaded.cases]
            results = [_member(s[name]) for s in found.stress]
            keys = [k for k, v in results[0].items() if not isinstance(v, list)]
            write_table(name, columns, ((k, [r[k] for r in results]) for k in keys))
        for a in found.assumed:
            print(f"Assumed {a.value}: {a.reason}")
    return ended(found)


def _member(found: RootStress) -> dict[str, Any]:
    """Greatest stress, where it is, and how it comes and goes there."""
    k = found.critical
    opposite = found.side != found.loaded_side
    return {
        "max_principal_MPa": found.max_principal,
        "max_von_mises_MPa": found.max_von_mises,
        "most_compressed_MPa": found.most_compressed,
        "side": SIDES[int(found.side[k])],
        "cone_distance_mm": float(found.distance[k]),
        "height_mm": float(found.height[k]),
        "at_pinion_angle_deg": degrees(found.pinion_angle[int(found.greatest[:, k].argmax())]),
        "opposite_fillet_most_compressed_MPa": float(found.least[:, opposite].min(initial=0.0)),
        "opposite_least_principal_MPa": found.least[:, found.most_pressed].tolist()
        if found.most_pressed >= 0
        else [],
        "pinion_angle_deg": np.degrees(found.pinion_angle).tolist(),
        "principal_there_MPa": found.greatest[:, k].tolist(),
        "least_principal_there_MPa": found.least[:, k].tolist(),
    }
