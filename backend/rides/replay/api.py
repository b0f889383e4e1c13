"""Proposals: settings for a wish, found on rides; a job that can be watched and cancelled."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, Response

from backend.law.rider_and_bike import RiderAndBike
from backend.rides.replay.proposal_models import Proposal, ProposalRequest
from backend.rides.replay.propose import Proposals
from backend.web.problem import refusals
from backend.web.services import provided

router = APIRouter(prefix="/proposals", tags=["proposals"], responses=refusals(404))
TheProposals = Annotated[Proposals, provided("proposals")]
JOB = Path(max_length=40)


@router.post(
    "",
    operation_id="propose",
    status_code=202,
    response_model=Proposal,
    responses=refusals(404, 409),
)
def propose(body: ProposalRequest, proposals: TheProposals, response: Response) -> Any:
    """Begins to look for settings; nothing is written to any unit."""
    job = proposals.begin(
        body.ride_ids,
        body.objective,
        body.knobs,
        body.target_pct,
        RiderAndBike(mass_kg=body.mass_kg, drag_area_m2=body.drag_area_m2),
    )
    response.headers["location"] = f"/api/v1/proposals/{job.id}"
    return job


@router.get("/{proposal_id}", operation_id="get_proposal", response_model=Proposal)
def get_proposal(proposals: TheProposals, proposal_id: str = JOB) -> Any:
    """How far it is, and what was found."""
    return proposals.get(proposal_id)


@router.delete("/{proposal_id}", operation_id="cancel_proposal", response_model=Proposal)
def cancel_proposal(proposals: TheProposals, proposal_id: str = JOB) -> Any:
    """Gives it up; one that is over stays as it is."""
    return proposals.cancel(proposal_id)
