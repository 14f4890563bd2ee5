"""What an ImageProcessor does with a frame: it calls the function, and publishes the outputs."""

import numpy as np
from sensor_msgs.msg import Image

from imgproc_course.learner_errors import failed_line
from imgproc_course.messages import ConversionError, array_to_image


class SkippedImageError(Exception):
    """An image could not be processed. The text gives the cause in one line; the node continues."""


def call_process(process, frame, parameters, outputs):
    """{output: array} of these outputs; a result that is a function is called only if it is one of them."""
    try:
        results = process(frame, **parameters)
        if isinstance(results, dict) and results.keys() >= set(outputs):
            values = {output: results[output] for output in outputs}
            return {output: value() if callable(value) else value for output, value in values.items()}
    except Exception as error:  # process is other people's code, and the node must live on
        # Its last line in the learner's own file helps more than one deep in a library that it called.
        own_file = getattr(getattr(process, "__code__", None), "co_filename", "")
        raise SkippedImageError(f"process failed {failed_line(error, own_file)}") from error
    returned = list(results) if isinstance(results, dict) else f"a {type(results).__name__}"
    raise SkippedImageError(f"process must return a dict with the keys {outputs}, but it returned {returned}")


class OutputPublishers:
    """Publishes each output, an array, as sensor_msgs/Image on `~/<output>`."""

    def __init__(self, node, outputs, qos, log):
        self._context = node.context
        self.publishers = {}
        for output in outputs:
            events = log.publisher_events(node.resolve_topic_name(f"~/{output}"))
            self.publishers[output] = node.create_publisher(Image, f"~/{output}", qos, event_callbacks=events)

    def subscribed(self):
        return [output for output, publisher in self.publishers.items() if publisher.get_subscription_count()]

    def publish(self, arrays, header):
        """Publishes {output: array} with this header. Returns False if ROS was shut down meanwhile."""
        try:
            messages = {
                output: array_to_image(array, _encoding_of(array), header) for output, array in arrays.items()
            }
        except ConversionError as error:
            raise SkippedImageError(f"process did not return an image: {error}") from error
        try:
            for output, message in messages.items():
                self.publishers[output].publish(message)
        except RuntimeError as error:
            if self._context.ok():
                raise SkippedImageError(f"the middleware does not accept the images: {error}") from error
            return False
        return True


def _encoding_of(array):
    if isinstance(array, np.ndarray) and array.dtype == np.uint8:
        return "mono8" if array.ndim == 2 else "bgr8" if array.shape[2:] == (3,) else "passthrough"
    return "passthrough"
