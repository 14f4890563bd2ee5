"""The kernel's connection to the browser, without the pause of 40 ms before a short message."""

from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection


class PromptWebsocketConnection(ZMQChannelsWebsocketConnection):
    """Jupyter Server's own connection, on a socket that sends at once.

    A moved slider answers in four or five short messages. TCP holds the second of them back until the browser
    has acknowledged the first (Nagle's algorithm, RFC 896), and the browser's side waits 40 ms for something
    to acknowledge it with. Tornado leaves this choice to the application; Jupyter Server 2.21 does not make
    it. Can go when a release of Jupyter Server calls `set_nodelay` itself.
    """

    def connect(self):
        self.websocket_handler.set_nodelay(True)
        return super().connect()
