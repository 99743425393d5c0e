#!/usr/bin/env python3
"""thread_times.py PID: watches a process until it ends; prints its processor time, and that of the threads that wait for the network."""
import json
import os
import pathlib
import sys
import time

HZ = os.sysconf("SC_CLK_TCK")


def look(task):
    fields = (task / "stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / HZ, (task / "wchan").read_text()


def main():
    tasks = pathlib.Path("/proc") / sys.argv[1] / "task"
    times, network = {}, set()
    begin = time.monotonic()
    while True:
        try:
            for task in tasks.iterdir():
                seconds, waits_for = look(task)
                times[task.name] = seconds
                if "skb" in waits_for:
                    network.add(task.name)
        except (FileNotFoundError, ProcessLookupError):
            if not tasks.exists() or not times:
                break
        state = pathlib.Path(f"/proc/{sys.argv[1]}/stat")
        if not state.exists() or state.read_text().rsplit(")", 1)[1].split()[0] == "Z":
            break
        time.sleep(0.1)
    print(json.dumps({
        "elapsed_s": time.monotonic() - begin,
        "all_s": sum(times.values()),
        "network_s": sum(times[name] for name in network),
    }))


main()
