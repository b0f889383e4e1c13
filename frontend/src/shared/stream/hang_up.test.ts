// @vitest-environment happy-dom
import { expect, it, vi } from 'vitest'
import { hangUp } from './hang_up'

const socketThat = (readyState: number) =>
  ({ readyState, close: vi.fn(), onopen: null, onmessage: vi.fn(), onclose: vi.fn() }) as unknown as
    WebSocket & { close: ReturnType<typeof vi.fn>; onopen: (() => void) | null }

it('closes a socket that is open, and hears nothing more of it', () => {
  const socket = socketThat(WebSocket.OPEN)

  hangUp(socket)

  expect(socket.close).toHaveBeenCalledOnce()
  expect([socket.onmessage, socket.onclose]).toEqual([null, null])
})

it('closes a socket that still connects only once it is open', () => {
  const socket = socketThat(WebSocket.CONNECTING)

  hangUp(socket)
  expect(socket.close).not.toHaveBeenCalled()
  socket.onopen?.()

  expect(socket.close).toHaveBeenCalledOnce()
})
