"""Commands: what they print, their time limit, and that nothing of them is left."""

import pathlib
import threading
import time
import unittest

import processes

HERE = pathlib.Path(__file__).parent


def ends_soon(pid):
    """Whether a process is gone, or only waits to be counted, within two seconds."""
    for _ in range(100):
        try:
            if pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] in "ZX":
                return True
        except OSError:
            return True
        time.sleep(0.02)
    return False


class Commands(unittest.TestCase):
    def test_status_output_and_environment(self):
        ended = processes.run(["sh", "-c", "echo $COLOUR; echo b >&2; exit 3"], HERE, 20, {"COLOUR": "red"})
        self.assertEqual((ended.status, ended.output), (3, "red\nb\n"))
        self.assertEqual(processes.run(["sh", "-c", "kill -SEGV $$"], HERE, 20).status, -11)

    def test_a_limit_of_memory(self):
        self.assertEqual(processes.run(["sh", "-c", "ulimit -v; ulimit -c"], HERE, 20, megabytes=1000).output, "1024000\n0\n")

    def test_the_time_limit_ends_what_the_command_started(self):
        # With -m, sh gives its child a process group of its own, as ninja does.
        ended = processes.run(["sh", "-mc", "trap '' TERM; sleep 1000 & echo $!; exec >&-; wait"], HERE, 1)
        self.assertIsNone(ended.status)
        self.assertTrue(ends_soon(ended.output.split()[-1]))

    def test_what_a_command_leaves_behind_is_ended(self):
        ended = processes.run(["sh", "-c", "sleep 1000 & echo $!"], HERE, 20)
        self.assertTrue(ends_soon(ended.output.split()[-1]))

    def test_a_stop_is_no_time_out(self):
        self.addCleanup(processes.allow)
        threading.Timer(0.2, processes.stop_all).start()
        with self.assertRaises(processes.Stopped):
            processes.run(["sleep", "1000"], HERE, 1000)
        with self.assertRaises(processes.Stopped):
            processes.run(["true"], HERE, 1000)


if __name__ == "__main__":
    unittest.main()
