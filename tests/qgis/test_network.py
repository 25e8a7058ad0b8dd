"""The same tests of remote files as without QGIS, with the network manager of QGIS."""

import pytest
import test_remote
from qgis.core import QgsApplication, QgsAuthMethodConfig
from remote_server import serving
from test_remote import DATA, fetched, wanted

from bare_earth.algorithms.remote import transfers
from bare_earth.plugin import network

# Not those of http.client itself, of its proxies and of passwords in addresses.
_OWN = (
    "connections_are_kept", "proxy", "password", "silent_server", "addresses", "not_there",
    "ign_is_asked",
)  # fmt: skip
globals().update(
    {
        name: test
        for name, test in vars(test_remote).items()
        if name.startswith("test_") and not any(words in name for words in _OWN)
    }
)


@pytest.fixture
def server():
    with serving() as running:
        yield running


@pytest.fixture(autouse=True)
def readers(monkeypatch):
    made = []

    def make():
        made.append(network.QgisReader())
        return made[-1]

    monkeypatch.setattr(transfers, "_READERS", [make])
    return made


def test_a_password_goes_to_the_named_host_only(server, tmp_path, monkeypatch):
    manager, config = QgsApplication.authManager(), QgsAuthMethodConfig("Basic")
    assert manager.setMasterPassword("master", True)
    config.setName("a server")
    config.setConfig("username", "me")
    config.setConfig("password", "SECRET")
    assert manager.storeAuthenticationConfig(config)
    login = config.id() or config[1].id()
    network.use_for(server.address("a"), login)
    server.add("b", DATA)
    target = f"to {server.address('b', 'localhost')}"
    server.fault = lambda number, path: target if path == "a" else ""
    found = fetched(server.address("a"), tmp_path / "parts", refusal=None)[0]
    assert found == wanted()
    by_path = {path: headers for path, _, headers, _ in server.asked}
    assert by_path["a"]["Authorization"].startswith("Basic ")
    assert "Authorization" not in by_path["b"]


def test_the_tests_are_of_this_reader(server, tmp_path, readers):
    fetched(server.add("a", DATA), tmp_path / "parts")
    assert len(readers) == 1 and readers[0].requests == len(server.asked)
