"""What a thread prints is captured; what other threads print is not."""

import sys
import threading

from imgproc_course.display.printing import captured_prints, last_lines


def test_only_the_calling_threads_prints_are_captured(capsys):
    stdout = sys.stdout
    other_printed, is_capturing = threading.Event(), threading.Event()
    collected = []

    def work():
        with captured_prints() as pieces:
            print("from the thread")
            is_capturing.set()
            assert other_printed.wait(60)
            print("a\nb\nc")
            collected.append(last_lines(pieces))
            assert pieces == []

    thread = threading.Thread(target=work)
    thread.start()
    assert is_capturing.wait(60)
    print("from the cell", flush=True)
    other_printed.set()
    thread.join()
    assert collected == ["a\nb\nc"]
    assert capsys.readouterr().out == "from the cell\n"
    assert sys.stdout is stdout


def test_two_threads_share_one_stream_and_the_last_one_removes_it():
    stdout = sys.stdout
    with captured_prints() as pieces:
        inner_pieces = []

        def work():
            with captured_prints() as thread_pieces:
                print("inner")
                inner_pieces.extend(thread_pieces)

        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
        print("outer")
    assert (pieces, inner_pieces) == (["outer", "\n"], ["inner", "\n"])
    assert sys.stdout is stdout
