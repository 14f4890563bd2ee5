"""What the robot process runs: the body that `open_camera` asks for."""

import cv2

from imgproc_course.recording import open_recording
from imgproc_course.ros.camera_publisher import CameraPublisher
from imgproc_course.ros.image_sources import RecordedImages, Webcam
from imgproc_course.ros.robot_process import serve
from imgproc_course.ros.session import RosSession


def open_body(request):
    """The body for a request of `open_camera`, with the same errors; it publishes after its `start`."""
    source, topic = request["source"], request["topic"]
    if source == "topic":
        return OtherPublisher(topic)
    if source == "room":
        # Only for a room: what draws it takes a while to import.
        from imgproc_course.ros.room_publisher import open_room

        return open_room(request)
    if source == "webcam":
        return CameraPublisher(topic, Webcam(), f"a webcam on {topic}")
    recording = open_recording(request["recording"], camera_topic=request["camera_topic"])
    images = RecordedImages(recording, request["speed"], request["loop"], request["stamps"])
    description = f"playing {request['recording']} at {images.rate:g} Hz on {topic}"
    return CameraPublisher(topic, images, description)


class OtherPublisher:
    """Publishes nothing: another node, such as a real robot's bridge, publishes the topic."""

    running = True

    def __init__(self, topic):
        self._topic = topic
        self.description = f"a camera that another node publishes on {topic}"

    def start(self, on_end):
        pass

    def stop(self):
        self.running = False

    def status(self):
        return {"running": False, "topic": self._topic}


def main(arguments):
    # For images of the robot's size OpenCV's threads take more of the processor's time than they save.
    cv2.setNumThreads(1)
    serve(arguments, open_body)
    RosSession().stop()
