//! The shared memory services of one run: a pair of data and event channels each way.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use iceoryx2::config::Config;
use iceoryx2::identifiers::UniqueNodeId;
use iceoryx2::port::listener::Listener;
use iceoryx2::port::notifier::Notifier;
use iceoryx2::port::publisher::{Publisher, PublisherCreateError};
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::{
    AllocationStrategy, BackpressureStrategy, CallbackProgression, EventId, Node, NodeBuilder, NodeName,
    PortFactory, ServiceName, SignalHandlingMode,
};
use iceoryx2::service::port_factory::{event, publish_subscribe};

use crate::domain::Ipc;
use crate::error::CouplerError;
use crate::frame::FrameHeader;
use crate::kinds::Participant;
use crate::watch::{PeerWatch, is_alive};

/// A frame was handed over.
const FRAME_EVENT: EventId = EventId::new(1);
/// The peer's notifier went away in good order, or was cleared away after its death.
const GONE_EVENTS: [EventId; 2] = [EventId::new(2), EventId::new(3)];
/// A frame in new memory was read.
const READ_EVENT: EventId = EventId::new(4);
/// Opening may collide with the peer creating or removing the same service.
const OPEN_RETRY: Duration = Duration::from_secs(1);

type DataService = publish_subscribe::PortFactory<Ipc, [f64], FrameHeader>;
type EventService = event::PortFactory<Ipc>;

/// This participant's ends. Fields drop in this order: ports before services, services before the node.
#[derive(Debug)]
pub(crate) struct Ports {
    pub(crate) publisher: Publisher<Ipc, [f64], FrameHeader>,
    pub(crate) subscriber: Subscriber<Ipc, [f64], FrameHeader>,
    pub(crate) notifier: Notifier<Ipc>,
    pub(crate) listener: Listener<Ipc>,
    data_out: DataService,
    data_in: DataService,
    event_out: EventService,
    event_in: EventService,
    _node: Node<Ipc>,
}

/// What a wait on the listener brought.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Wake {
    /// Nothing came in time, or the peer's notifier went away: time to look whether it lives.
    pub(crate) look_around: bool,
    /// So many frames in new memory were read.
    pub(crate) read: u64,
}

impl Ports {
    /// Creates what is not there yet; the publisher first, so that a second participant of this name is refused
    /// before it disturbs anything.
    pub(crate) fn open(
        config: &Config,
        run_id: &str,
        name: Participant,
        initial_len: usize,
        watch: &Arc<PeerWatch>,
    ) -> Result<Self, CouplerError> {
        let node_name = NodeName::new(&format!("{run_id}/{name}")).map_err(failed("naming the node"))?;
        let node = patiently("creating the node", || {
            NodeBuilder::new()
                .config(config)
                .name(&node_name)
                .signal_handling_mode(SignalHandlingMode::Disabled)
                .create::<Ipc>()
        })?;
        let outward = service_name(run_id, name)?;
        let inward = service_name(run_id, name.peer())?;

        let data_out = open_data(&node, &outward)?;
        let asked = Arc::clone(watch);
        let publisher = data_out
            .publisher_builder()
            .initial_max_slice_len(initial_len.max(1))
            .allocation_strategy(AllocationStrategy::PowerOfTwo)
            .backpressure_strategy(BackpressureStrategy::RetryUntilDelivered)
            .set_backpressure_handler(move |info| asked.while_blocked(info))
            .create()
            .map_err(|error| match error {
                PublisherCreateError::ExceedsMaxSupportedPublishers => CouplerError::NameTaken {
                    name,
                    run_id: run_id.to_owned(),
                    pid: publisher_of(&data_out).map_or(0, pid_of),
                },
                other => failed("creating the sending end")(other),
            })?;
        let data_in = open_data(&node, &inward)?;
        let subscriber =
            data_in.subscriber_builder().create().map_err(failed("creating the receiving end"))?;
        let event_out = open_event(&node, &outward)?;
        let event_in = open_event(&node, &inward)?;
        let notifier = event_out
            .notifier_builder()
            .default_event_id(FRAME_EVENT)
            .create()
            .map_err(failed("creating the notifier"))?;
        let listener = event_in.listener_builder().create().map_err(failed("creating the listener"))?;
        Ok(Self {
            publisher,
            subscriber,
            notifier,
            listener,
            data_out,
            data_in,
            event_out,
            event_in,
            _node: node,
        })
    }

    /// The peer's node, once all its ends are there and it lives.
    pub(crate) fn connected_peer(&self, config: &Config) -> Option<UniqueNodeId> {
        let complete = self.data_out.dynamic_config().number_of_subscribers() == 1
            && self.event_out.dynamic_config().number_of_listeners() == 1
            && self.event_in.dynamic_config().number_of_notifiers() == 1;
        let peer = publisher_of(&self.data_in).filter(|_| complete)?;
        is_alive(config, peer).then_some(peer)
    }

    /// Whether somebody still listens.
    pub(crate) fn has_peer(&self) -> bool {
        self.data_out.dynamic_config().number_of_subscribers() > 0
    }

    /// Connects to the peer's sending end, without which its frames would only be kept up to the first.
    pub(crate) fn attach(&self) -> Result<(), CouplerError> {
        self.subscriber.has_samples().map(|_| ()).map_err(failed("connecting to the peer"))
    }

    /// Tells the peer that its frame in new memory was read.
    pub(crate) fn confirm_read(&self) {
        if let Err(error) = self.notifier.notify_with_custom_event_id(READ_EVENT) {
            tracing::debug!(%error, "the peer could not be told that its frame was read");
        }
    }

    /// Blocks until an event or the time-out.
    pub(crate) fn wait(&self, timeout: Duration) -> Wake {
        let mut wake = Wake::default();
        let woken = self.listener.timed_wait(
            |activation| {
                wake.look_around |= GONE_EVENTS.contains(&activation.id);
                wake.read += if activation.id == READ_EVENT { activation.count } else { 0 };
            },
            timeout,
        );
        // An error is a signal handler that ran meanwhile.
        wake.look_around |= !matches!(woken, Ok(1..));
        wake
    }
}

pub(crate) fn pid_of(node: UniqueNodeId) -> u32 {
    node.pid::<Ipc>().map_or(0, |pid| pid.value() as u32)
}

/// `cav/<run id>/fluid-to-solid` and back: from `sender` to its peer.
fn service_name(run_id: &str, sender: Participant) -> Result<ServiceName, CouplerError> {
    ServiceName::new(&format!("cav/{run_id}/{sender}-to-{}", sender.peer()))
        .map_err(failed("naming the service"))
}

fn publisher_of(service: &DataService) -> Option<UniqueNodeId> {
    let mut node = None;
    service.dynamic_config().list_publishers(|details| {
        node = Some(details.node_id);
        CallbackProgression::Stop
    });
    node
}

fn open_data(node: &Node<Ipc>, name: &ServiceName) -> Result<DataService, CouplerError> {
    patiently("opening the data service", || {
        node.service_builder(name)
            .publish_subscribe::<[f64]>()
            .user_header::<FrameHeader>()
            .enable_safe_overflow(false)
            .history_size(0)
            .subscriber_max_buffer_size(1)
            .subscriber_max_borrowed_samples(1)
            .max_publishers(1)
            .max_subscribers(1)
            // Two work, a third must get as far as being told that the name is taken.
            .max_nodes(4)
            .open_or_create()
    })
}

fn open_event(node: &Node<Ipc>, name: &ServiceName) -> Result<EventService, CouplerError> {
    patiently("opening the event service", || {
        node.service_builder(name)
            .event()
            .notifier_dropped_event(GONE_EVENTS[0])
            .notifier_dead_event(GONE_EVENTS[1])
            .max_notifiers(1)
            .max_listeners(1)
            .max_nodes(4)
            .open_or_create()
    })
}

fn patiently<T, E: std::fmt::Debug>(
    what: &'static str,
    mut attempt: impl FnMut() -> Result<T, E>,
) -> Result<T, CouplerError> {
    let start = Instant::now();
    loop {
        match attempt() {
            Ok(value) => return Ok(value),
            Err(error) if start.elapsed() > OPEN_RETRY => return Err(failed(what)(error)),
            Err(_) => thread::sleep(Duration::from_millis(10)),
        }
    }
}

pub(crate) fn failed<E: std::fmt::Debug>(what: &'static str) -> impl FnOnce(E) -> CouplerError {
    move |error| CouplerError::SharedMemory { what, cause: format!("{error:?}") }
}
