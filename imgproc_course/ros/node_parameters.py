"""The ROS parameters of an ImageProcessor: the numbers that `process` takes."""

from rcl_interfaces.msg import SetParametersResult


class NodeParameters:
    """Declares the parameters, checks every request to change them, and holds their `values`."""

    def __init__(self, node, numeric_parameters, check):
        self._types = {p.name: type(p.default) for p in numeric_parameters}
        self._check = check
        declared = [(p.name, p.default, p.descriptor()) for p in numeric_parameters]
        self.values = self._checked({p.name: p.value for p in node.declare_parameters("", declared)})
        node.add_on_set_parameters_callback(self._validate)
        node.add_post_set_parameters_callback(self._apply)

    def _checked(self, values):
        """The values in their declared types; ValueError if they are refused."""
        for name, value in values.items():
            if isinstance(value, bool) or not isinstance(value, int | float):
                raise ValueError(f"{name} must be a number, got {value!r}")
        values = {name: self._types[name](value) for name, value in values.items()}
        if self._check is not None:
            self._check(**values)
        return values

    def _merged(self, request):
        """All values as they are after the request."""
        changes = {parameter.name: parameter.value for parameter in request if parameter.name in self.values}
        return {**self.values, **changes}

    def _validate(self, request):
        """Called once for all parameters of a request: either all are accepted, or none."""
        try:
            self._checked(self._merged(request))
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _apply(self, request):
        # One assignment: an image is processed with all old values or with all new ones, never with a mix.
        self.values = self._checked(self._merged(request))
