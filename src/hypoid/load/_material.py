"""What teeth are made of."""

from __future__ import annotations

from dataclasses import dataclass

from hypoid.geometry import DesignError, Problem


@dataclass(frozen=True)
class Material:
    """An isotropic elastic material."""

    youngs_modulus: float = 206e3  # E, MPa
    poissons_ratio: float = 0.3  # nu

    @property
    def plane_modulus(self) -> float:
        """E/(1 - nu**2), MPa: how stiff a half-space is."""
        return self.youngs_modulus / (1.0 - self.poissons_ratio**2)

    @property
    def lame(self) -> tuple[float, float]:
        """Lame's constants lambda and mu, MPa."""
        nu = self.poissons_ratio
        mu = self.youngs_modulus / (2.0 * (1.0 + nu))
        return 2.0 * mu * nu / (1.0 - 2.0 * nu), mu


STEEL = Material()


def material(path: str, youngs_modulus: float, poissons_ratio: float) -> Material:
    """A material of E (MPa) and nu; DesignError, with `path` before the names, where these are none."""
    problems: list[Problem] = []
    if not youngs_modulus > 0.0:
        problems.append(
            Problem(f"{path}youngs-modulus", f"{youngs_modulus:g} MPa", "more than 0", "206 GPa")
        )
    if not 0.0 <= poissons_ratio < 0.5:
        expected = "from 0 to less than 0.5: at 0.5 a solid keeps its volume and displacements do not tell stress"
        problems.append(Problem(f"{path}poissons-ratio", f"{poissons_ratio:g}", expected, "0.3"))
    if problems:
        raise DesignError(problems)
    return Material(youngs_modulus, poissons_ratio)
