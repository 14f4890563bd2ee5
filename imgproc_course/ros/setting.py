"""A number that a node lets be changed. Imports no ROS, so that a node's functions can be used without."""

from typing import NamedTuple


class Setting(NamedTuple):
    """A number that may be changed while the node runs: a ROS parameter, and a keyword of `process`.

    Attributes
    ----------
    name : of the parameter and of the keyword
    default : an int takes whole numbers only; a float takes both
    least, most : the range, both ends included
    description : what it does, with its unit
    """

    name: str
    default: int | float
    least: int | float
    most: int | float
    description: str

    def descriptor(self):
        """The rcl_interfaces/ParameterDescriptor of the parameter."""
        from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

        whole = isinstance(self.default, int)
        return ParameterDescriptor(
            description=self.description,
            # ROS itself would refuse the 1 of `ros2 param set NODE sigma 1`, because 1 is no float.
            dynamic_typing=not whole,
            integer_range=[IntegerRange(from_value=int(self.least), to_value=int(self.most))],
            floating_point_range=[
                FloatingPointRange(from_value=float(self.least), to_value=float(self.most))
            ],
        )
