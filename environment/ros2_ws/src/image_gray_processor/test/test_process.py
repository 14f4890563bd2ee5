import numpy as np
from image_gray_processor.image_gray_processor import process


def test_luma_of_one_blue_one_green_one_red_and_one_white_pixel():
    frame = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
    assert process(frame)["gray"].tolist() == [[29, 150], [76, 255]]
