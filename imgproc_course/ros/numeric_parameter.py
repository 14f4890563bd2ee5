"""A numeric ROS parameter of a node. Imports no ROS, so that a node's functions can be used without ROS."""

from typing import Any, NamedTuple


class NumericParameter(NamedTuple):
    """A number that can be changed while the node runs: a ROS parameter, and a keyword of `process`.

    Attributes
    ----------
    name : of the parameter and of the keyword
    default : if it is an int, the parameter accepts whole numbers only; if it is a float, it accepts both
    minimum, maximum : the range; both ends are allowed
    description : what the number does, with its unit
    """

    name: str
    default: int | float
    minimum: int | float
    maximum: int | float
    description: str

    def descriptor(self) -> Any:
        """The rcl_interfaces/ParameterDescriptor of the parameter."""
        from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

        low, high = self.minimum, self.maximum
        return ParameterDescriptor(
            description=self.description,
            # ROS itself would refuse the 1 of `ros2 param set NODE sigma 1`, because 1 is not a float.
            dynamic_typing=not isinstance(self.default, int),
            integer_range=[IntegerRange(from_value=int(low), to_value=int(high))],
            floating_point_range=[FloatingPointRange(from_value=float(low), to_value=float(high))],
        )
