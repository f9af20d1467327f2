//! Where finished bands go, one on its way while the next is drawn.

use crate::window::Window;

/// What takes finished bands: a display's driver, with DMA or without.
///
/// Sending takes the buffer itself and waiting gives it back, so that the compiler sees to it that what is on its way is
/// not drawn into; HALs' DMA transfers want the same. At most one is on its way at a time.
///
/// With a HAL whose transfers own their buffer and their channel:
///
/// ```
/// use fixel::{bands::Sink, window::Window};
/// # struct Dma;
/// # struct Transfer(&'static mut [u16], Dma);
/// # impl Dma {
/// #     fn start(self, pixels: &'static mut [u16]) -> Transfer { Transfer(pixels, self) }
/// # }
/// # impl Transfer {
/// #     fn wait(self) -> (&'static mut [u16], Dma) { (self.0, self.1) }
/// # }
///
/// struct Panel {
///     /// Here between transfers.
///     dma: Option<Dma>,
/// }
///
/// impl Sink<u16, &'static mut [u16]> for Panel {
///     type Transfer = Result<Transfer, &'static mut [u16]>;
///     type Error = ();
///
///     fn send(&mut self, _window: Window, band: &'static mut [u16]) -> Self::Transfer {
///         // First the commands that set the display's window, then:
///         self.dma.take().map(|dma| dma.start(band)).ok_or(&mut [])
///     }
///
///     fn wait(&mut self, transfer: Self::Transfer) -> (&'static mut [u16], Result<(), ()>) {
///         match transfer {
///             Ok(transfer) => {
///                 let (band, dma) = transfer.wait();
///                 self.dma = Some(dma);
///                 (band, Ok(()))
///             }
///             Err(band) => (band, Err(())),
///         }
///     }
/// }
/// ```
pub trait Sink<P, B> {
    /// A band on its way.
    type Transfer;
    /// What can go wrong.
    type Error;

    /// Starts to send a band: the first width × height pixels in it, row after row. What fails here is told by
    /// [`wait`](Self::wait), which gives the buffer back whatever happened.
    fn send(&mut self, window: Window, band: B) -> Self::Transfer;

    /// Waits until the band has been sent.
    fn wait(&mut self, transfer: Self::Transfer) -> (B, Result<(), Self::Error>);
}

/// A sink that has sent the band when it returns: a function of the band's place and its pixels.
///
/// The example is [`Bands`](super::Bands)'s.
#[derive(Debug, Clone, Copy)]
pub struct Blocking<S>(pub S);

impl<P, B, S, E> Sink<P, B> for Blocking<S>
where
    B: AsMut<[P]>,
    S: FnMut(Window, &[P]) -> Result<(), E>,
{
    type Transfer = (B, Result<(), E>);
    type Error = E;

    fn send(&mut self, window: Window, mut band: B) -> (B, Result<(), E>) {
        // The buffer holds at least that many, see `Bands::new`.
        let count = window.width().saturating_mul(window.height());
        let sent = (self.0)(window, band.as_mut().get(..count).unwrap_or_default());
        (band, sent)
    }

    fn wait(&mut self, transfer: (B, Result<(), E>)) -> (B, Result<(), E>) {
        transfer
    }
}

/// The buffers that are here, and the one that is on its way.
pub(super) struct Queue<'q, P, B, S: Sink<P, B>> {
    idle: &'q mut [Option<B>; 2],
    sink: &'q mut S,
    under_way: Option<S::Transfer>,
}

impl<'q, P, B, S: Sink<P, B>> Queue<'q, P, B, S> {
    pub(super) fn new(idle: &'q mut [Option<B>; 2], sink: &'q mut S) -> Self {
        Queue {
            idle,
            sink,
            under_way: None,
        }
    }

    /// Draws a band into a buffer that is not on its way, and sends it as soon as the one before has been.
    ///
    /// Does nothing where there is no buffer, which `Bands::new` rules out.
    pub(super) fn band(&mut self, window: Window, draw: impl FnOnce(&mut B)) -> Result<(), S::Error> {
        if self.idle.iter().all(Option::is_none) {
            self.settle()?;
        }
        let Some(mut buffer) = self.idle.iter_mut().find_map(Option::take) else {
            return Ok(());
        };
        draw(&mut buffer);
        if let Err(error) = self.settle() {
            self.put(buffer);
            return Err(error);
        }
        self.under_way = Some(self.sink.send(window, buffer));
        Ok(())
    }

    /// Waits until nothing is on its way.
    pub(super) fn settle(&mut self) -> Result<(), S::Error> {
        let Some(transfer) = self.under_way.take() else {
            return Ok(());
        };
        let (buffer, sent) = self.sink.wait(transfer);
        self.put(buffer);
        sent
    }

    fn put(&mut self, buffer: B) {
        if let Some(place) = self.idle.iter_mut().find(|place| place.is_none()) {
            *place = Some(buffer);
        }
    }
}
