"""Solids: a tooth, a sector or a gear with its body, as meshes of its exact surfaces."""

from ._body import Body as Body
from ._body import body as body
