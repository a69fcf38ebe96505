"""Three network namespaces on a bridge: one of the scheduler and the driver, two of workers. Each loses packets that arrive."""

import contextlib
import shutil
import subprocess

HUB, WORKERS = "plfarmhub", ("plfarm1", "plfarm2")
HUB_ADDRESS = "10.213.7.1"


class Impossible(Exception):
    """Why this machine cannot do it."""


def _run(*words, text=None):
    answer = subprocess.run(words, capture_output=True, text=True, input=text)
    if answer.returncode:
        raise Impossible(f"{' '.join(words)}: {answer.stderr.strip().splitlines()[:1]}")


@contextlib.contextmanager
def namespaces(percent):
    """Yields how packets are dropped. Raises Impossible."""
    if not shutil.which("ip"):
        raise Impossible("there is no `ip` (Debian: iproute2)")
    try:
        for name in (HUB, *WORKERS):
            _run("ip", "netns", "add", name)
            _run("ip", "-n", name, "link", "set", "lo", "up")
        _run("ip", "-n", HUB, "link", "add", "bridge0", "type", "bridge")
        _run("ip", "-n", HUB, "addr", "add", f"{HUB_ADDRESS}/24", "dev", "bridge0")
        _run("ip", "-n", HUB, "link", "set", "bridge0", "up")
        for number, name in enumerate(WORKERS):
            _run("ip", "-n", HUB, "link", "add", f"port{number}", "type", "veth", "peer", "name", "eth0", "netns", name)
            _run("ip", "-n", HUB, "link", "set", f"port{number}", "master", "bridge0", "up")
            _run("ip", "-n", name, "addr", "add", f"10.213.7.{11 + number}/24", "dev", "eth0")
            _run("ip", "-n", name, "link", "set", "eth0", "up")
        yield _lose(percent)
    finally:
        for name in (HUB, *WORKERS):
            subprocess.run(["ip", "netns", "del", name], capture_output=True)


def _lose(percent):
    """netem where the kernel has it, on both ends of each cable; else nftables, where packets arrive."""
    try:
        for number, name in enumerate(WORKERS):
            for place, device in ((HUB, f"port{number}"), (name, "eth0")):
                _run("tc", "-n", place, "qdisc", "add", "dev", device, "root", "netem", "loss", f"{percent}%")
        return "netem"
    except (Impossible, FileNotFoundError) as no_netem:
        if not shutil.which("nft"):
            raise Impossible(f"neither netem ({no_netem}) nor nft (Debian: nftables)") from None
    rules = f"""table inet loss {{
        chain arriving {{
            type filter hook input priority 0
            iifname != "lo" numgen random mod 100 < {percent} counter drop
        }}
    }}
    """
    for name in (HUB, *WORKERS):
        _run("ip", "netns", "exec", name, "nft", "-f", "-", text=rules)
    return "nftables"


def dropped():
    """What nftables has counted: text for the log."""
    return "".join(
        subprocess.run(["ip", "netns", "exec", name, "nft", "list", "ruleset"], capture_output=True, text=True).stdout
        for name in (HUB, *WORKERS)
    )
