"""The CAD kernel (Open CASCADE by the package OCP): the one file that calls it.

Its names moved between the releases 7.9 and 8.0; both are met here.
"""

# The kernel comes without types.
# pyright: reportMissingImports=false, reportMissingModuleSource=false
# pyright: reportAttributeAccessIssue=false

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager
from functools import cached_property
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from hypoid.geometry import DesignError, Problem
from hypoid.solid import Arc, Brep, Flat, Segment, SplineCurve, SplineSurface, Turned

Array = np.ndarray[Any, Any]
INSTALL = 'pip install "hypoid[cad]"'
SCHEMA = "AP242DIS"
LEAST = 1e-7  # mm, the kernel's own least tolerance
HEAD = 50  # entities at a model's head, where its product stands
CANDIDATES = 12  # faces that are looked at for where a point belongs


def available() -> bool:
    """Whether the CAD kernel is installed."""
    return find_spec("OCP") is not None


def need_kernel() -> None:
    if not available():
        given = "no CAD kernel on this machine"
        raise DesignError([Problem("STEP", given, "the optional extra `cad`", INSTALL)])


def _module(name: str) -> Any:
    return import_module(f"OCP.{name}")


def _array(kind: str, *shape: int) -> Any:
    """An array of the kernel's, by the name it has in either release, from index 1 on."""
    bounds = [bound for n in shape for bound in (1, n)]
    if find_spec("OCP.collections") is not None:
        return getattr(_module("collections"), f"Array{len(shape)}_{kind}")(*bounds)
    module, name = {
        "double": ("TColStd", "Real"),
        "int": ("TColStd", "Integer"),
        "gp_Pnt": ("TColgp", "Pnt"),
        "gp_Pnt2d": ("TColgp", "Pnt2d"),
    }[kind]
    return getattr(_module(module), f"{module}_Array{len(shape)}Of{name}")(*bounds)


def _knots(knots: Array) -> tuple[Any, Any, int]:
    """Distinct knots, their multiplicities and the degree."""
    values, counts = np.unique(knots, return_counts=True)
    distinct, multiplicity = _array("double", len(values)), _array("int", len(values))
    for k, (value, count) in enumerate(zip(values, counts, strict=True), 1):
        distinct.SetValue(k, float(value))
        multiplicity.SetValue(k, int(count))
    return distinct, multiplicity, int(counts[0]) - 1


def _spline(curve: SplineCurve) -> Any:
    gp = _module("gp")
    knots, counts, degree = _knots(curve.knots)
    flat = curve.poles.shape[1] == 2
    poles = _array("gp_Pnt2d" if flat else "gp_Pnt", len(curve.poles))
    made = gp.gp_Pnt2d if flat else gp.gp_Pnt
    for k, pole in enumerate(curve.poles.tolist(), 1):
        poles.SetValue(k, made(*pole))
    kind = _module("Geom2d").Geom2d_BSplineCurve if flat else _module("Geom").Geom_BSplineCurve
    return kind(poles, knots, counts, degree)


def _curve(curve: SplineCurve | Arc | Segment) -> Any:
    if isinstance(curve, SplineCurve):
        return _spline(curve)
    gp, geom = _module("gp"), _module("Geom")
    if isinstance(curve, Segment):
        start, direction = gp.gp_Pnt(*curve.start.tolist()), gp.gp_Dir(*curve.direction.tolist())
        return geom.Geom_Line(start, direction)
    axes = gp.gp_Ax2(gp.gp_Pnt(0.0, 0.0, curve.z), gp.gp_Dir(0, 0, 1), gp.gp_Dir(1, 0, 0))
    return geom.Geom_Circle(axes, curve.radius)


def _surface(surface: SplineSurface | Flat | Turned) -> Any:
    gp, geom = _module("gp"), _module("Geom")
    if isinstance(surface, SplineSurface):
        (u, u_counts, u_degree), (v, v_counts, v_degree) = (_knots(k) for k in surface.knots)
        poles = _array("gp_Pnt", *surface.poles.shape[:2])
        for i, row in enumerate(surface.poles.tolist(), 1):
            for j, pole in enumerate(row, 1):
                poles.SetValue(i, j, gp.gp_Pnt(*pole))
        return geom.Geom_BSplineSurface(poles, u, v, u_counts, v_counts, u_degree, v_degree)
    if isinstance(surface, Flat):
        point, normal = surface.point.tolist(), surface.normal.tolist()
        return geom.Geom_Plane(gp.gp_Pnt(*point), gp.gp_Dir(*normal))
    start = gp.gp_Dir(float(np.cos(surface.zero)), float(np.sin(surface.zero)), 0.0)
    axes = gp.gp_Ax3(gp.gp_Pnt(0.0, 0.0, surface.z), gp.gp_Dir(0.0, 0.0, surface.axis), start)
    if surface.lean:
        return geom.Geom_ConicalSurface(axes, surface.lean, surface.radius)
    return geom.Geom_CylindricalSurface(axes, surface.radius)


def solid(brep: Brep) -> tuple[Any, list[Any]]:
    """The kernel's solid of a B-rep, and its faces in the same order."""
    gp, topods = _module("gp"), _module("TopoDS")
    build, place = _module("BRep").BRep_Builder(), _module("TopLoc").TopLoc_Location()
    widest = [LEAST] * len(brep.points)
    for edge in brep.edges:
        for end in (edge.start, edge.end):
            widest[end] = max(widest[end], edge.tolerance)
    vertices: list[Any] = []
    for point, tolerance in zip(brep.points, widest, strict=True):
        vertex = topods.TopoDS_Vertex()
        build.MakeVertex(vertex, gp.gp_Pnt(*point.tolist()), tolerance)
        vertices.append(vertex)
    edges: list[Any] = []
    for edge in brep.edges:
        made = topods.TopoDS_Edge()
        build.MakeEdge(made, _curve(edge.curve), edge.tolerance)
        build.Add(made, _oriented(vertices[edge.start], True))
        build.Add(made, _oriented(vertices[edge.end], False))
        build.Range(made, edge.low, edge.high)
        edges.append(made)
    shell, faces = topods.TopoDS_Shell(), list[Any]()
    build.MakeShell(shell)
    for face in brep.faces:
        made, surface = topods.TopoDS_Face(), _surface(face.surface)
        build.MakeFace(made, surface, place, LEAST)
        for loop in face.loops:
            wire = topods.TopoDS_Wire()
            build.MakeWire(wire)
            over: dict[int, list[Any]] = {}  # there and back again along a seam
            for use in sorted(loop, key=lambda use: not use.forward):
                if use.on is not None:
                    over.setdefault(use.edge, []).append(_spline(use.on))
            for k, curves in over.items():
                build.UpdateEdge(edges[k], *curves, surface, place, brep.edges[k].tolerance)
            for use in loop:
                build.Add(wire, _oriented(edges[use.edge], use.forward))
            wire.Closed(True)
            build.Add(made, wire)
        faces.append(_oriented(made, face.outward))
        build.Add(shell, faces[-1])
    shell.Closed(True)
    whole = topods.TopoDS_Solid()
    build.MakeSolid(whole)
    build.Add(whole, shell)
    return whole, faces


def write(path: Path, brep: Brep, name: str) -> None:
    """Write a B-rep as a STEP file of one named part; faces carry their names."""
    control, static = _module("STEPControl"), _module("Interface").Interface_Static
    text = _module("TCollection").TCollection_HAsciiString
    shape, faces = solid(brep)
    with _quiet():
        writer = control.STEPControl_Writer()
        static.SetCVal_s("write.step.schema", SCHEMA)
        static.SetIVal_s("write.surfacecurve.mode", 0)  # edges by their curves in space alone
        kind = control.STEPControl_StepModelType.STEPControl_ManifoldSolidBrep
        done = [writer.Transfer(shape, kind)]
        known = writer.WS().TransferWriter().FinderProcess()
        for face, made in zip(brep.faces, faces, strict=True):
            entity = _module("STEPConstruct").STEPConstruct.FindEntity_s(known, made)
            if entity is not None:
                entity.SetName(text(face.name))
        model = writer.Model()
        for k in range(1, min(HEAD, model.NbEntities()) + 1):
            if isinstance(entity := model.Value(k), _module("StepBasic").StepBasic_Product):
                entity.SetId(text(name))
                entity.SetName(text(name))
        header = _module("APIHeaderSection").APIHeaderSection_MakeHeader(model)
        header.SetName(text(name))
        header.SetDescriptionValue(1, text("Exact tooth surfaces as splines, mm"))
        header.SetAuthorValue(1, text(""))
        header.SetOrganizationValue(1, text(""))
        header.SetOriginatingSystem(text("hypoid"))
        done.append(writer.Write(str(path)))
    if any(one != _module("IFSelect").IFSelect_ReturnStatus.IFSelect_RetDone for one in done):
        given = "a solid that the CAD kernel could not write"
        raise DesignError([Problem("STEP", given, "room for temporary files", "another TMPDIR")])


class StepFile:
    """A STEP file as the kernel reads it: what it is worth as a solid."""

    def __init__(self, path: Path) -> None:
        control, top = _module("STEPControl"), _module("TopAbs").TopAbs_ShapeEnum
        with _quiet():
            reader = control.STEPControl_Reader()
            reader.ReadFile(str(path))
            reader.TransferRoots()
            self.shape = reader.OneShape()
        self.faces = self._parts(top.TopAbs_FACE)
        self.solids = len(self._parts(top.TopAbs_SOLID))
        self._shells = self._parts(top.TopAbs_SHELL)
        self._volume = _module("GProp").GProp_GProps()
        _module("BRepGProp").BRepGProp.VolumeProperties_s(self.shape, self._volume)

    def _parts(self, kind: Any) -> list[Any]:
        seen, found = _module("TopExp").TopExp_Explorer(self.shape, kind), list[Any]()
        while seen.More():
            found.append(seen.Current())
            seen.Next()
        return found

    @property
    def valid(self) -> bool:
        """Whether the kernel finds no fault in geometry and topology."""
        return bool(_module("BRepCheck").BRepCheck_Analyzer(self.shape).IsValid())

    @property
    def closed(self) -> bool:
        """Whether it is one solid whose one shell has no free edge."""
        closed = _module("BRep").BRep_Tool.IsClosed_s
        return self.solids == 1 and len(self._shells) == 1 and bool(closed(self._shells[0]))

    @property
    def volume(self) -> float:
        """Volume, mm³."""
        return float(self._volume.Mass())

    @property
    def centre(self) -> tuple[float, float, float]:
        """Centre of mass, mm."""
        at = self._volume.CentreOfMass()
        return float(at.X()), float(at.Y()), float(at.Z())

    @property
    def inertia(self) -> Array:
        """Matrix of inertia (3, 3) about the centre of mass, mm⁵."""
        value = self._volume.MatrixOfInertia().Value
        return np.array([[float(value(i, j)) for j in (1, 2, 3)] for i in (1, 2, 3)])

    @property
    def tolerance(self) -> float:
        """Greatest tolerance of an edge, vertex or face, mm."""
        return float(
            _module("ShapeAnalysis").ShapeAnalysis_ShapeTolerance().Tolerance(self.shape, 1)
        )

    def distances(self, points: Array) -> Array:
        """Distances (n,), mm, of points beside one spline face from that face, wherever it is in the file."""
        project = _module("GeomAPI").GeomAPI_ProjectPointOnSurf
        middle = points[len(points) // 2]
        centres, surfaces = self._splines
        near = np.argsort(np.linalg.norm(centres - middle, axis=1))[:CANDIDATES]
        found = [project(_point(middle), surfaces[k]) for k in near]
        ways = [f.LowerDistance() if f.NbPoints() else np.inf for f in found]
        best = found[int(np.argmin(ways))]
        distances = np.full(len(points), np.inf)
        for k, point in enumerate(points):
            best.Perform(_point(point))
            if best.NbPoints():
                distances[k] = best.LowerDistance()
        return distances

    @cached_property
    def _splines(self) -> tuple[Array, list[Any]]:
        """The spline faces' surfaces, and a point in the middle of each."""
        on, kind = _module("BRep").BRep_Tool.Surface_s, _module("Geom").Geom_BSplineSurface
        face = _module("TopoDS").TopoDS
        cast = getattr(face, "Face", None) or face.Face_s
        surfaces = [s for s in (on(cast(f)) for f in self.faces) if isinstance(s, kind)]
        middles: list[list[float]] = []
        for surface in surfaces:
            u0, u1, v0, v1 = surface.Bounds()
            at = surface.Value(0.5 * (u0 + u1), 0.5 * (v0 + v1))
            middles.append([at.X(), at.Y(), at.Z()])
        return np.array(middles), surfaces


def _point(point: Array) -> Any:
    return _module("gp").gp_Pnt(*point.tolist())


@contextmanager
def _quiet() -> Generator[None]:
    """The kernel says what it does on standard output, which is for results: only failures then."""
    message = _module("Message")
    printers = list(message.Message.DefaultMessenger_s().Printers())
    levels = [printer.GetTraceLevel() for printer in printers]
    for printer in printers:
        printer.SetTraceLevel(message.Message_Gravity.Message_Fail)
    try:
        yield
    finally:
        for printer, level in zip(printers, levels, strict=True):
            printer.SetTraceLevel(level)


def _oriented(shape: Any, forward: bool) -> Any:
    top = _module("TopAbs").TopAbs_Orientation
    return shape.Oriented(top.TopAbs_FORWARD if forward else top.TopAbs_REVERSED)
