(** * even-emission-body: A source that is the same everywhere in a body of 300

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 3750 * s - 1 / 1125000 * s ^ 2.
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  1 / 3375000 * (450 * lambda ^ 2 - lambda ^ 3).
Definition exact_radiance (lambda : R) : R :=
  1 - exp (-1 / 3375000 * (450 * lambda ^ 2 - lambda ^ 3)).

Theorem even_emission_body (D : R) :
  0 <= D <= 300 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
