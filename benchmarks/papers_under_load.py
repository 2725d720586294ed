"""The papers' cases under load: the tables of docs/validation/under-load.md, and of the fillets' elements.

    python benchmarks/papers_under_load.py 2022 docs/validation/relief-under-load.csv
    python benchmarks/papers_under_load.py 2005 docs/validation/torques.csv
    python benchmarks/papers_under_load.py fillets docs/validation/root-stress.csv

2022: section 6.3 and Fig. 13, 110 N m, five tip reliefs, both readings of where their height counts
from. 2005: section 4.2.2, Table 4, seven torques of the 15 x 44 pair. Fillets: root stress of the 2022
pair with relief at 110 N m, four positions a pitch, by elements over the fillet.
"""

from __future__ import annotations

import csv
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from hypoid.design import TipRelief, build
from hypoid.io import read_spec
from hypoid.load import MESHES, STEEL, Material, loaded_contact, pair_compliance, root_stress

EXAMPLES = Path(__file__).parent.parent / "examples"
NM, URAD = 1e3, 1e6
RELIEFS = (0.002, 0.003, 0.004, 0.005, 0.006)  # 1/mm, Fig. 13
ROUNDING = 0.2  # mm, assumed: of the tips in the last two columns
TORQUES = (100.0, 170.0, 250.0, 335.0, 500.0, 670.0, 940.0)  # N m, Table 4
STEEL_2005 = Material(210e3, 0.3)  # section 4.2


def row(case: Any, loaded: Any) -> dict[str, Any]:
    """What both tables show of one torque."""
    counts = [len(p.pairs) for p in case.pitch]
    edges = sorted({p.edge for at in case.pitch for p in at.pairs if p.edge})
    stress = {m: root_stress(loaded, case, m) for m in ("pinion", "wheel")}
    tips = [p for at in case.pitch for p in at.pairs if p.edge.endswith("tip")]
    return {
        "pairs": f"{min(counts)}-{max(counts)}",
        "contact_ratio": round(case.contact_ratio, 2),
        "greatest_MPa": round(case.max_pressure),
        "at_a_tip_MPa": round(max((p.edge_pressure for p in tips), default=0.0)),
        "edges": " ".join(edges) or "none",
        "edge_force_kN": round(
            1e-3 * max(sum(p.edge_force for p in at.pairs) for at in case.pitch), 2
        ),
        "te_urad": round(case.peak_to_peak * URAD, 1),
        "root_von_mises_pinion_MPa": round(stress["pinion"].max_von_mises),
        "root_von_mises_wheel_MPa": round(stress["wheel"].max_von_mises),
    }


def reliefs(mesh: str) -> list[dict[str, Any]]:
    """Fig. 13 of the 2022 paper, drive side, once for each reading of the relief's height."""
    spec = read_spec(EXAMPLES / "gonzalez-fuentes-2022.toml")
    made: list[dict[str, Any]] = []
    for measured_from in ("tip", "pitch"):
        for coefficient in RELIEFS:
            relief = TipRelief(coefficient, 1.5, measured_from, "drive")  # pyright: ignore
            pair = build(replace(spec, tip_relief=relief))
            teeth = pair_compliance(pair, "drive", STEEL, MESHES[mesh])
            loaded = loaded_contact(pair, "drive", [110.0 * NM], *teeth, positions=21)
            found = row(loaded.cases[0], loaded)
            rounded = {m.name: replace(m, tip_rounding=ROUNDING) for m in (pair.pinion, pair.wheel)}
            on_arcs = loaded_contact(replace(pair, **rounded), "drive", [110.0 * NM], *teeth)
            found["greatest_tips_rounded_MPa"] = round(on_arcs.cases[0].max_pressure)
            found["at_a_rounded_tip_MPa"] = round(on_arcs.cases[0].tip_pressure)
            made.append({"measured_from": measured_from, "relief_per_mm": coefficient, **found})
            print(made[-1], file=sys.stderr, flush=True)
    return made


def torques(mesh: str) -> list[dict[str, Any]]:
    """Table 4 of the 2005 paper."""
    pair = build(read_spec(EXAMPLES / "vimercati-piazza-2005.toml"))
    teeth = pair_compliance(pair, "drive", STEEL_2005, MESHES[mesh])
    begun = time.perf_counter()
    loaded = loaded_contact(pair, "drive", [t * NM for t in TORQUES], *teeth, positions=33)
    print(f"{time.perf_counter() - begun:.0f} s", file=sys.stderr)
    return [
        {"torque_Nm": t, **row(case, loaded)} for t, case in zip(TORQUES, loaded.cases, strict=True)
    ]


def fillets(mesh: str) -> list[dict[str, Any]]:
    """Greatest root stress against elements over the fillet."""
    pair = build(read_spec(EXAMPLES / "gonzalez-fuentes-2022-relief.toml"))
    usual = MESHES[mesh]
    meshes = {"coarse": MESHES["coarse"], "": replace(usual, fillet=4), mesh: usual}
    made: list[dict[str, Any]] = []
    for name, elements in (*meshes.items(), ("", replace(usual, fillet=10))):
        teeth = pair_compliance(pair, "drive", STEEL, elements)
        loaded = loaded_contact(pair, "drive", [110.0 * NM], *teeth, positions=9)
        stress = [root_stress(loaded, loaded.cases[0], m) for m in ("pinion", "wheel")]
        made.append(
            {
                "over the fillet": elements.fillet,
                "mesh": name,
                "pinion [MPa]": round(stress[0].max_principal),
                "wheel [MPa]": round(stress[1].max_principal),
                "greatest pressure [MPa]": round(loaded.cases[0].max_pressure),
            }
        )
    return made


def main() -> None:
    which, path, mesh = sys.argv[1], Path(sys.argv[2]), (*sys.argv[3:], "usual")[0]
    rows = {"2022": reliefs, "2005": torques, "fillets": fillets}[which](mesh)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
