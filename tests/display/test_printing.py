"""What a thread prints is kept for it; what anybody else prints goes where it went."""

import sys
import threading

from imgproc_course.display.printing import last_lines, prints_kept


def test_only_the_calling_threads_prints_are_kept(capsys):
    before = sys.stdout
    other_printed, keep_open = threading.Event(), threading.Event()
    collected = []

    def work():
        with prints_kept() as kept:
            print("from the thread")
            keep_open.set()
            assert other_printed.wait(20)
            print("a\nb\nc")
            collected.append(last_lines(kept))
            assert kept == []

    thread = threading.Thread(target=work)
    thread.start()
    assert keep_open.wait(20)
    print("from the cell", flush=True)
    other_printed.set()
    thread.join()
    assert collected == ["a\nb\nc"]
    assert capsys.readouterr().out == "from the cell\n"
    assert sys.stdout is before


def test_two_threads_share_one_stream_and_the_last_takes_it_away():
    before = sys.stdout
    with prints_kept() as kept:
        inner = []

        def work():
            with prints_kept() as own:
                print("inner")
                inner.extend(own)

        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
        print("outer")
    assert (kept, inner) == (["outer", "\n"], ["inner", "\n"])
    assert sys.stdout is before
