"""The kernel's connection to the browser, without a delay of 40 ms before short messages."""

from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection


class PromptWebsocketConnection(ZMQChannelsWebsocketConnection):
    """Jupyter Server's own connection, on a socket that sends at once.

    After a slider has moved, the kernel sends four or five short messages. TCP delays the second until the
    browser has acknowledged the first (Nagle's algorithm, RFC 896), which the browser does after up to 40 ms.
    Tornado lets the application switch this off; Jupyter Server 2.21 does not do it. This class can go when a
    release of Jupyter Server calls `set_nodelay` itself.
    """

    def connect(self):
        self.websocket_handler.set_nodelay(True)
        return super().connect()
