"""ROS 2 packages: a function returns their files, which are read, and their node is driven."""
