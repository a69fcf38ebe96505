"""The machine that measures: its processor, and how much else it does."""

import os
import time

# A machine that does nothing else has a load of a few hundredths.
QUIET_LOAD = 0.3
QUIET_SHARE = 0.05


def processor():
    fields = {}
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            key, _, value = line.partition(":")
            fields.setdefault(key.strip(), value.strip())
    vectors = [name for name in ("avx2", "avx512f") if name in fields.get("flags", "").split()]
    return (f"{fields.get('model name', 'unknown processor')}, family {fields.get('cpu family', '?')}, "
            f"{os.cpu_count()} threads, {' '.join(vectors)}")


def busy_share(seconds=1.0):
    """Of the time of all processors, what is used now."""
    def ticks():
        with open("/proc/stat", encoding="utf-8") as file:
            values = list(map(int, file.readline().split()[1:9]))
        return sum(values), sum(values) - values[3] - values[4]
    total, busy = ticks()
    time.sleep(seconds)
    total_end, busy_end = ticks()
    return (busy_end - busy) / max(total_end - total, 1)


def load():
    """Before or after measuring: uptime's averages, and the share that is in use."""
    one, five, fifteen = os.getloadavg()
    return {"load": [round(each, 2) for each in (one, five, fifteen)], "busy": round(busy_share(), 3)}


def is_quiet(state):
    return state["load"][0] <= QUIET_LOAD and state["busy"] <= QUIET_SHARE


def describe(state):
    return f"load {' '.join(f'{each:.2f}' for each in state['load'])}, {100 * state['busy']:.0f}% of the processors in use"
