"""Classes of ROS 2 nodes: a node is made, gets messages, and what it does is compared."""
