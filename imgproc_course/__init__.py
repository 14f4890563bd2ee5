"""Image processing in ROS 2: the Python package of the course.

messages    sensor_msgs/Image <-> NumPy      imaging     the mathematics, by hand
recording   the recorded drive               ros         a running graph
simulation  the room, without ROS            geometry    from pixels to the room
display     what a notebook shows            exercises   what lessons import of nbclassroom
cli         the command imgproc-course       doctor      checks of the machine
"""
