"""The counter of lost messages: gaps in the publisher's own numbers."""

from imgproc_course.ros.stream_statistics import LossCounter


def received(*numbers):
    counter = LossCounter()
    for number in numbers:
        counter.receive(number)
    return counter


def test_each_missing_number_is_a_lost_message():
    assert received(7, 8, 11, 12).lost == 2
    assert received(1, 2, 3).lost == 0


def test_before_the_first_message_nothing_is_lost():
    assert LossCounter().lost == 0


def test_numbers_that_go_back_are_not_losses():
    assert received(50, 51, 1, 2, 4).lost == 1


def test_messages_without_numbers_make_the_losses_unknown():
    counter = received(1, 4, None)
    assert (counter.lost, counter.total) == (None, 2)


def test_two_publishers_make_the_losses_unknown_until_one_is_left():
    counter = received(1, 3)
    counter.set_publishers(2)
    counter.receive(900)
    assert (counter.lost, counter.total) == (None, 1)
    counter.set_publishers(1)
    counter.receive(5)
    counter.receive(8)
    assert counter.lost == 3
