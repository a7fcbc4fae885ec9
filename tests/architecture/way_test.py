"""The way of a study from POST /v1/runs to the FEM's process goes through six rooms, each entered once. Prints it, with the call
that leads from each file to the next."""
import os
import pathlib
import re
import sys

root = pathlib.Path(os.environ.get("BREACH_ROOT", pathlib.Path(__file__).parents[2]))
service = "services/orchestrator/"
# (file, the call that it makes, file in which that is defined). A step may begin in any file that was reached before.
way = [
    ("http/http_runs.cpp", "accept_study(", "http/http_submission.cpp"),
    ("http/http_submission.cpp", "sent_study(", "http/sent_documents.cpp"),
    ("http/sent_documents.cpp", "read_study_document(", "study/read_study.cpp"),
    ("study/read_study.cpp", "check_scene_of_study(", "study/checked_scene.cpp"),
    ("study/checked_scene.cpp", "check::checked_document(", "core/check/check.cpp"),
    ("http/http_submission.cpp", "transaction.add_run(", "store/transaction.cpp"),
    ("http/http_submission.cpp", "dispatcher.wake(", "dispatch/dispatcher.cpp"),
    ("dispatch/dispatcher.cpp", "attempts_.start(", "dispatch/attempts.cpp"),
    ("dispatch/attempts.cpp", "executor_.submit(", "executors/local_executor.cpp"),
    ("executors/local_executor.cpp", "\"supervise\"", "executors/supervisor.cpp"),
    ("executors/supervisor.cpp", "execv", ""),
]
rooms = ["http", "study", "core/check", "store", "dispatch", "executors"]


def text_of(file):
    return (root / (file if file.startswith("core/") else service + file)).read_text()


def room_of(file):
    return "/".join(file.split("/")[:2]) if file.startswith("core/") else file.split("/")[0]


def main():
    entered = [room_of(way[0][0])]
    for file, call, to in way:
        if call not in text_of(file):
            sys.exit(f"{file} does not call {call.strip('(')}: follow the new way here, or keep it to {len(rooms)} rooms")
        name = re.search(r"(\w+)\($", call)
        if to and name and not re.search(rf"\b{name[1]}\(", text_of(to)):
            sys.exit(f"{name[1]} is not in {to}: follow the new way here, or keep it to {len(rooms)} rooms")
        print(f"{file:32} {call.strip('('):28} {to or 'the phase'}")
        if to and room_of(to) != room_of(file):
            entered.append(room_of(to))
    if entered != rooms:
        sys.exit(f"the way enters {' '.join(entered)}, not {' '.join(rooms)}")


if __name__ == "__main__":
    main()
