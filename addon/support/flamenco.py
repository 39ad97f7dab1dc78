# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hand a job to the manager of a Flamenco 3 farm, over HTTP, once somebody asks for it.

Nothing but the address that was given is asked, whatever proxies the system has, and no answer
leads elsewhere. Source: the manager's OpenAPI document, `flamenco-openapi.yaml`, version 3.
"""

from __future__ import annotations

import json
import platform
import urllib.request
from collections.abc import Mapping
from http.client import HTTPException
from typing import Any
from urllib.error import HTTPError
from urllib.parse import quote, urlsplit

from ...core.errors import OutputError

JOB_TYPE = "rough-spectra"
"""What the manager calls `farm/flamenco/rough_spectra.js`."""

SECONDS = 4.0
"""That an answer may take; the window waits so long."""
_LONGEST = 2**20  # bytes of an answer
_SHOWN = 200  # characters of an answer in a sentence
_PRIORITY = 50  # what Flamenco's own panel begins with


class _Stays(urllib.request.HTTPRedirectHandler):
    """Follow no answer to another address."""

    def redirect_request(self, *_: Any) -> None:
        """Give no further request, which makes the redirection an error."""


def checked(address: str) -> str:
    """Return an address such as ``http://farm:8080`` without what may be left out.

    Raises
    ------
    OutputError
        It is none.

    Examples
    --------
    >>> checked("farm.local:8080/")
    'http://farm.local:8080'
    """
    full = address.strip() if "://" in address else f"http://{address.strip()}"
    try:
        parts = urlsplit(full)
        host, _ = parts.hostname, parts.port
    except ValueError:
        host, parts = None, urlsplit("")
    if parts.scheme not in ("http", "https") or not host:
        raise OutputError(
            f"{address!r} is no address of a Flamenco manager; write one such as http://farm:8080 "
            "in the preferences."
        )
    return f"{parts.scheme}://{parts.netloc}{parts.path.rstrip('/')}"


def submit(address: str, name: str, settings: Mapping[str, Any]) -> str:
    """Hand a job of our type to the manager; returns its number.

    Parameters
    ----------
    address
        Of the manager.
    name
        What the job is called there.
    settings
        By the keys of the job type.

    Raises
    ------
    OutputError
        Nobody answers, who answers is no such manager, or it refuses; the sentence says what to do.
    """
    manager = checked(address)
    told = _ask(f"{manager}/api/v3/version")
    if "flamenco" not in str(told.get("name", "")).lower():
        raise OutputError(
            f"What answers at {manager} is no Flamenco manager; mend the address in the "
            "preferences."
        )
    try:
        known = _ask(f"{manager}/api/v3/jobs/type/{quote(JOB_TYPE)}")
    except _UnknownError:
        raise OutputError(
            f"The Flamenco manager at {manager} does not know the job type {JOB_TYPE}; copy "
            "rough_spectra.js into its folder 'scripts' and restart it."
        ) from None
    job = {
        "name": name,
        "type": JOB_TYPE,
        "priority": _PRIORITY,
        "submitter_platform": platform.system().lower(),
        "settings": dict(settings),
        "metadata": {},
    }
    if known.get("etag"):
        job["type_etag"] = known["etag"]
    return str(_ask(f"{manager}/api/v3/jobs", job).get("id", ""))


class _UnknownError(OutputError):
    """The manager has nothing at this address."""


def _ask(url: str, content: Mapping[str, Any] | None = None) -> dict[str, Any]:
    data = None if content is None else json.dumps(content).encode()
    request = urllib.request.Request(url, data, {"Content-Type": "application/json"})
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}), _Stays)
    try:
        with opener.open(request, timeout=SECONDS) as answer:
            found = json.loads(answer.read(_LONGEST))
    except HTTPError as error:
        kind = _UnknownError if error.code == 404 else OutputError
        raise kind(f"{url} refuses: {_said(error)}; mend what it says and submit again.") from error
    except (OSError, HTTPException, ValueError) as error:
        reason = getattr(error, "reason", None) or error
        raise OutputError(
            f"No Flamenco manager answers at {url} ({reason}); start it, or mend the address in "
            "the preferences."
        ) from error
    if not isinstance(found, dict):
        raise OutputError(f"{url} answers as no Flamenco manager does; mend the address.")
    return found


def _said(error: HTTPError) -> str:
    """Return what the manager says of a refusal, on one line."""
    try:
        text = str(json.loads(error.read(_LONGEST))["message"])
    except (OSError, HTTPException, ValueError, KeyError, TypeError):
        text = f"{error.code} {error.reason}"
    return " ".join(text.split())[:_SHOWN].rstrip(".")
