/** Closes a socket and hears nothing more of it. One that still connects is closed once it is open:
    a browser reports anything earlier as a connection that failed. */
export function hangUp(socket: WebSocket): void {
  socket.onmessage = null
  socket.onclose = null
  if (socket.readyState === WebSocket.CONNECTING) socket.onopen = () => socket.close()
  else socket.close()
}
