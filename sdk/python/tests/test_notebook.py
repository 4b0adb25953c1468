"""Tests the view for notebooks, without a notebook."""
from html.parser import HTMLParser

import pytest

import gsv


class Elements(HTMLParser):
    def __init__(self, html):
        super().__init__()
        self.found = {}
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self.found[tag] = dict(attributes)


class Served:
    """A fake simulation."""

    def __init__(self, url):
        self._url = url

    def viewer_url(self):
        return self._url


def test_view_is_an_element_of_the_server_of_the_simulation():
    view = gsv.view(Served("http://127.0.0.1:8080/?simulation=my%20run"), follow="pebble", fov=60)
    found = Elements(view._repr_html_()).found
    assert found["script"]["src"] == "http://127.0.0.1:8080/gsv-view.js"
    assert found["gsv-view"]["src"] == "http://127.0.0.1:8080/?simulation=my%20run"
    assert found["gsv-view"]["follow"] == "pebble"
    assert found["gsv-view"]["fov"] == "60"
    assert "height: 420px" in found["gsv-view"]["style"]
    # Where scripts do not run, a stream of images shows the view.
    assert found["img"]["src"] == ("http://127.0.0.1:8080/view.mjpeg?simulation=my+run"
                                   "&follow=pebble&fov=60")


def test_view_of_an_address_escapes_the_address():
    view = gsv.view('http://host:1/"><script>alert(1)</script>', label='a "b" <c>')
    assert "<script>alert" not in view._repr_html_()
    found = Elements(view._repr_html_()).found
    assert found["gsv-view"]["label"] == 'a "b" <c>'


def test_view_rejects_what_it_cannot_show():
    with pytest.raises(gsv.Unavailable, match="no viewer"):
        gsv.view(Served(""))
    with pytest.raises(TypeError, match="no attribute 'colour'"):
        gsv.view("http://host:1/", colour="red")
