"""The view of a simulation in a notebook."""

from __future__ import annotations

from html import escape
from typing import Any, Union
from urllib.parse import urlencode, urljoin, urlsplit, parse_qsl

from gsv.errors import Unavailable

_ATTRIBUTES = ("simulation", "eye", "target", "follow", "camera", "fov", "quality", "fps", "token", "label")
_NOT_OF_IMAGES = ("label",)


class View:
    """The view of a simulation as HTML, for Jupyter and other notebooks.

    The server renders the images, so the browser must be able to reach the server's address.
    """

    def __init__(self, url: str, width: str, height: str, attributes: dict[str, str]) -> None:
        self.url = url
        self._width, self._height = width, height
        self._attributes = attributes

    def _repr_html_(self) -> str:
        names = "".join(f' {name}="{escape(value)}"' for name, value in self._attributes.items())
        style = f"width: {self._width}; height: {self._height}"
        return (f'<script src="{escape(urljoin(self.url, "gsv-view.js"))}"></script>'
                f'<gsv-view src="{escape(self.url)}" style="{escape(style)}"{names}>'
                f'<img src="{escape(self._stream())}" alt="View of the simulation">'
                "</gsv-view>")

    def _stream(self) -> str:
        """Returns the address of the stream of images, for notebooks that run no scripts."""
        query = dict(parse_qsl(urlsplit(self.url).query))
        query = {"simulation": query["simulation"]} if "simulation" in query else {}
        query.update({name: value for name, value in self._attributes.items() if name not in _NOT_OF_IMAGES})
        stream = urljoin(self.url, "view.mjpeg")
        return f"{stream}?{urlencode(query)}" if query else stream

    def __repr__(self) -> str:
        return f"View({self.url!r})"


def view(simulation: Union[str, Any], *, width: str = "100%", height: str = "420px",
         **attributes: Union[str, float]) -> View:
    """Returns the view of a simulation. A notebook shows it as the result of a cell.

    `simulation` is a gsv.Simulation, or the address of a viewer ("http://127.0.0.1:8080/"). `width`
    and `height` are CSS lengths, such as "100%" or "420px". `attributes` are those of the element
    <gsv-view>: eye and target ("X,Y,Z" in metres), follow (a robot), camera ("ROBOT/CAMERA"), fov
    (degrees), quality, fps, token, label. Raises Unavailable if the simulation has no viewer, and
    TypeError for other attributes.
    """
    url = simulation if isinstance(simulation, str) else simulation.viewer_url()
    if not url:
        raise Unavailable("the simulation has no viewer: start its server without --headless")
    for name in attributes:
        if name not in _ATTRIBUTES:
            raise TypeError(f"there is no attribute {name!r}; use {', '.join(_ATTRIBUTES)}")
    return View(url, width, height, {name: str(value) for name, value in attributes.items()})
