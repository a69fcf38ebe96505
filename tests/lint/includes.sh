#!/usr/bin/env bash
# includes.sh ROOT: our folders include one another in one direction only. The two wings, ref/ and cuda/,
# are independent implementations: neither may include the other.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/files.sh"
cd "$1"
tracked '*.h' '*.cpp' '*.cu' '*.cuh' | xargs -0 -r awk '
    BEGIN {
        may["scenes"] = " scenes "
        may["images"] = " images "
        may["golden"] = " golden images "
        may["trade"] = " trade golden images "
        may["ref"] = " ref scenes images "
        may["cuda"] = " cuda scenes images "
        may["extremes"] = " extremes ref cuda scenes images "
        may["explain"] = " explain ref cuda scenes images "
        may["check"] = " check golden ref scenes images "
        may["examples"] = " cuda check golden ref scenes images "
        may["cli"] = " cli ref cuda golden trade check extremes explain scenes images "
        may["docs"] = " docs cli ref cuda golden trade check extremes explain scenes images "
        may["tests"] = " tests cli ref cuda golden trade check extremes explain scenes images "
    }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        split(FILENAME, from, "/")
        split($0, quoted, "\"")
        split(quoted[2], to, "/")
        if (!(from[1] in may)) problem = "is in no known folder"
        else if (index(quoted[2], "..")) problem = "includes by a relative path"
        else if (!(to[1] in may)) problem = "includes by a path that does not begin at the root"
        else if (!index(may[from[1]], " " to[1] " ")) problem = from[1] "/ must not include " to[1] "/"
        else next
        print FILENAME ":" FNR ": " problem ": " $0
        failed = 1
    }
    END { exit failed }'
